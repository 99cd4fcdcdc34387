// Buffers, parameters and state of the `path` kernel.
#ifndef RL_PATH_H
#define RL_PATH_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

struct PathBuffers {
  Vec3Ref radiance;
};

struct PathParams {
  uint padding;
};

struct PathState {
  vec3 radiance;
  vec3 unseen;  // of the last light sample, without its visibility
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS PathBuffers
#define RL_KERNEL_PARAMS PathParams

#endif
