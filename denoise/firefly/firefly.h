// Buffers and parameters of the `firefly` kernel.
#ifndef RL_FIREFLY_H
#define RL_FIREFLY_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "denoise/common/filter.h"

RL_NAMESPACE_BEGIN

struct FireflyBuffers {
  Vec3Ref radiance;
  Uvec4Ref guide;
  Vec3Ref shown;
};

struct FireflyParams {
  uint radius;  // pixels
  float factor;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS FireflyBuffers
#define RL_KERNEL_PARAMS FireflyParams

#endif
