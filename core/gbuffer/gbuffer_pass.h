// Buffers of the `gbuffer` kernel.
#ifndef RL_GBUFFER_PASS_H
#define RL_GBUFFER_PASS_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct GBufferBuffers {
  Uvec4Ref gbuffer;
  Uvec4Ref firstHits;  // at pixel centres; read if isRaster
};

struct GBufferParams {
  uint isRaster;  // 1: the rasteriser has found the surfaces
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS GBufferBuffers
#define RL_KERNEL_PARAMS GBufferParams

#endif
