// A parametric surface as triangles for a scene.
#pragma once

#include "core/scene/shapes/shape_info.h"
#include "core/scene/splines/tessellate.h"

namespace restlab {

// Reads a surface and `chord_error`, metres in the scene. Without it: a quarter of a pixel of an
// image of 1080 lines, seen from the nearest camera; where no camera is known yet, 1/4000 of the
// surface's size. Throws Error (badUsage) at the key that is wrong.
MeshGeometry readMeshOfSurface(const ConfigTable& table, const ShapePlace& place);

// The error in metres that a quarter of a pixel is at the surface.
double quarterOfPixel(const BezierGrid& grid, const glm::dmat4& toWorld,
                      const std::vector<SceneCamera>& cameras);

}  // namespace restlab
