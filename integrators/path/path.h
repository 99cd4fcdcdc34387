// Buffers and parameters of the `path` kernel.
#ifndef RL_PATH_H
#define RL_PATH_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct PathBuffers {
  Vec3Ref radiance;
};

struct PathParams {
  uint padding;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS PathBuffers
#define RL_KERNEL_PARAMS PathParams

#endif
