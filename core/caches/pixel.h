// Parameters of the pixel cache, in the kernels' gParams.cache.
#ifndef RL_PIXEL_CACHE_H
#define RL_PIXEL_CACHE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct PixelCacheParams {
  uint tile;  // pixels; side of the square within which pixels are paired
  float minNormalDot;
  float maxPlaneDistance;  // over the distance to the camera
};

RL_NAMESPACE_END

#endif
