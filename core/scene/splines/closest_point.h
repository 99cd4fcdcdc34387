// What is inside a closed surface.
#pragma once

#include "core/scene/splines/bezier.h"

namespace restlab {

// Whether the edges of a surface meet or are points, with the normals to the outside. Surfaces that
// only others close are open.
bool isClosedSurface(const BezierGrid& grid);

// Whether a point is on the inner side of the closest point of a closed surface.
bool isInsideSurface(const BezierGrid& grid, const glm::dvec3& p);

}  // namespace restlab
