// Buffers of the `trace` kernel: rays that the host made, to be timed or compared.
#ifndef RL_TRACE_KERNEL_H
#define RL_TRACE_KERNEL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct TraceResult {
  Hit hit;              // of a path ray
  float transmittance;  // as traceRay() returns it
};
RL_STATIC_ASSERT_SIZE(TraceResult, 24);

RL_REF(RayRef, Ray)
RL_REF(TraceResultRef, TraceResult)

struct TraceBuffers {
  RayRef rays;
  TraceResultRef results;
};

struct TraceParams {
  uint count;  // rays; at least this many pixels are dispatched
  uint mode;   // RL_RAY_PATH or RL_RAY_SHADOW
  uint alphaKey;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS TraceBuffers
#define RL_KERNEL_PARAMS TraceParams

#endif
