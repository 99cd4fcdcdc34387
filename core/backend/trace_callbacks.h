// Hands Embree's callbacks to the kernel that traces the ray: the filter of a partly transparent
// surface, the intersection with a shape.
#pragma once

#include "core/backend/embree.h"

namespace rl {

// The intersection context of a kernel: Embree's own, then the kernel's functions.
struct KernelTraceContext {
  EmbreeContext embree;
  RTCFilterFunctionN filter;
  RTCIntersectFunctionN intersectShape;
  RTCOccludedFunctionN occludedByShape;
};

// Set on meshes whose material may be transparent, and on no others: opaque hits cost no call.
inline void alphaFilterTrampoline(const RTCFilterFunctionNArguments* args) {
  reinterpret_cast<KernelTraceContext*>(args->context)->filter(args);
}

// Set on shapes: the kernel that traces the ray intersects them.
inline void shapeIntersectTrampoline(const RTCIntersectFunctionNArguments* args) {
  reinterpret_cast<KernelTraceContext*>(args->context)->intersectShape(args);
}
inline void shapeOccludedTrampoline(const RTCOccludedFunctionNArguments* args) {
  reinterpret_cast<KernelTraceContext*>(args->context)->occludedByShape(args);
}

}  // namespace rl
