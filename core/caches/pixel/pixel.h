// Buffers and parameters of the pixel cache.
#ifndef RL_PIXEL_CACHE_H
#define RL_PIXEL_CACHE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct PixelCacheBuffers {
  QuadRef visible;  // core/dialect/visible.h
  QuadRef visibleBefore;
  UintRef outlines;  // 1: a pixel beside it shows another surface
};

struct PixelCacheParams {
  uint tile;  // pixels; side of the square within which pixels are paired
  float minNormalDot;
  float maxPlaneDistance;  // over the distance to the camera
};

RL_NAMESPACE_END

#define RL_CACHE_BUFFERS PixelCacheBuffers
#define RL_CACHE_PARAMS PixelCacheParams

#endif
