#pragma once

#include <cstdint>

#include "core/dialect/types.h"
#include "core/raster/raster.h"
#include "shapes/list.h"

namespace restlab {

// Triangles that a raster pass draws of an instance: the parts of those of its mesh, or the sides
// of a shape's box.
inline uint32_t rasterTriangles(const rl::Geometry& geometry, uint32_t divisions) {
  return geometry.shape == rl::RL_SHAPE_TRIANGLES ? geometry.triangleCount << (2 * divisions) : 12;
}

}  // namespace restlab
