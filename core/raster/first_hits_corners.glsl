// first_hits_corners: the vertex stage of first hits. Corners have a place, and no light.
#include "core/raster/raster.glsl"

RL_FN RasterCorner rasterCorner(uint instance, uint part, uint corner) {
  return rasterPlace(instance, part, corner);
}

#include "core/raster/corners.glsl"
