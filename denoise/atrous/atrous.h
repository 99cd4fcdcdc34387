// Buffers and parameters of the kernels of `atrous`.
#ifndef RL_ATROUS_H
#define RL_ATROUS_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "denoise/common/filter.h"

RL_NAMESPACE_BEGIN

struct AtrousBuffers {
  Vec3Ref radiance;
  Uvec4Ref guide;
  Vec3Ref shown;
  Uvec4Ref even;  // Filtered, a uvec4 each: read by iterations 0, 2, ... and written by the others
  Uvec4Ref odd;
  Vec2Ref around;
};

struct AtrousParams {
  uint step;  // iteration of the pass
  uint iterations;
  float deviations;
  FilterEdges edges;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS AtrousBuffers
#define RL_KERNEL_PARAMS AtrousParams

#endif
