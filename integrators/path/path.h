// Buffers, parameters and state of the `path` kernel.
#ifndef RL_PATH_H
#define RL_PATH_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/radiance_cache/radiance.h"
#include "core/transport/light_sum.h"

RL_NAMESPACE_BEGIN

struct PathBuffers {
  RadianceBuffers cells;
  Vec3Ref radiance;
};

struct PathKernelParams {
  RadianceParams cells;
};

struct PathState {
  LightSum sum;
  CacheTermination end;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS PathBuffers
#define RL_KERNEL_PARAMS PathKernelParams

#endif
