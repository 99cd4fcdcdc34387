// Light found along a path (core/transport/light_sum.glsl).
#ifndef RL_LIGHT_SUM_H
#define RL_LIGHT_SUM_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

struct LightSum {
  vec3 radiance;
  vec3 unseen;  // unshadowed contribution of the last light sample
};

RL_NAMESPACE_END

#endif
