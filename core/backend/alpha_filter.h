// Hands Embree's filter of a partly transparent mesh to the kernel that traces the ray.
#pragma once

#include "core/backend/embree.h"

namespace rl {

// The intersection context of a kernel: Embree's own, then the kernel's filter.
struct AlphaTraceContext {
  EmbreeContext embree;
  RTCFilterFunctionN filter;
};

// Set on meshes whose material may be transparent, and on no others: opaque hits cost no call.
inline void alphaFilterTrampoline(const RTCFilterFunctionNArguments* args) {
  reinterpret_cast<AlphaTraceContext*>(args->context)->filter(args);
}

}  // namespace rl
