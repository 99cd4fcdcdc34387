// Meshes that their transform flattens to a plate.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// The transform of an instance, counted from the scene's origin, with the least thickness that
// keeps both sides of a plate apart: a few times as much as rays are moved off a surface. In place
// of no thickness, or of one a thousand million times less than its extent. Any other transform
// stays as it is.
glm::dmat4 withThickness(const glm::dmat4& toWorld, const MeshGeometry& mesh);

}  // namespace restlab
