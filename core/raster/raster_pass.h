// Buffers and parameters of the kernels of first hits.
#ifndef RL_RASTER_PASS_H
#define RL_RASTER_PASS_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/raster/raster.h"

RL_NAMESPACE_BEGIN

struct RasterPassBuffers {
  RasterBuffers raster;
};

struct RasterPassParams {
  RasterParams raster;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RasterPassBuffers
#define RL_KERNEL_PARAMS RasterPassParams

#endif
