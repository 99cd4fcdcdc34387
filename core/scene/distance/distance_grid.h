// Signed distances to a closed surface, sampled on a grid.
#pragma once

#include "core/scene/distance/triangles.h"
#include "core/scene/field/grid.h"

namespace restlab {

inline constexpr int kLeastCells = 8, kMostCells = 255;

// `cells` cubes along the longest edge of a box that leaves two around the surface. Samples are
// below 0 where the surface winds around them. Throws Error (badInput), without a file: no sample
// is inside.
SampledGrid distanceGrid(const ClosedTriangles& surface, int cells);

}  // namespace restlab
