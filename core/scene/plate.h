// Meshes whose transform flattens them to a plate.
#pragma once

#include "core/scene/scene.h"

namespace restlab {

// Gives the transform of an instance, relative to the scene's origin, the least thickness that
// keeps both sides of a plate apart: a few times the distance that rays are moved off a surface.
// Replaces a thickness of 0 or below 1e-9 of the extent; any other transform stays unchanged.
glm::dmat4 withThickness(const glm::dmat4& toWorld, const MeshGeometry& mesh);

}  // namespace restlab
