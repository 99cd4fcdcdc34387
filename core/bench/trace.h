// Buffers of the `trace` kernel: rays that the host made, to be timed or compared.
#ifndef RL_TRACE_KERNEL_H
#define RL_TRACE_KERNEL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct TraceResult {
  Hit hit;              // path rays only
  float transmittance;  // return value of traceRay()
};
RL_STATIC_ASSERT_SIZE(TraceResult, 24);

// A ray to trace, read as uvec4s. The mode is per ray, as in integrators.
struct TraceQuery {
  Ray ray;
  uint mode;  // RL_RAY_PATH or RL_RAY_SHADOW
  uint alphaKey;
  uint padding0;
  uint padding1;
};
RL_STATIC_ASSERT_SIZE(TraceQuery, 48);

RL_REF(TraceResultRef, TraceResult)

struct TraceBuffers {
  Uvec4Ref queries;
  TraceResultRef results;
};

struct TraceParams {
  uint count;  // rays; at least this many pixels are dispatched
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS TraceBuffers
#define RL_KERNEL_PARAMS TraceParams

#endif
