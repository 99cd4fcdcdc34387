// Vertices so far from their origin that float32 rounds them visibly.
#pragma once

#include <string>

#include "core/scene/compiled/scene_origin.h"

namespace restlab {

// Largest float32 spacing at a vertex, relative to the size of the scene, that gives no warning.
// docs/manual.md has measurements on both sides of this limit.
constexpr double kCoarsestVertices = 1e-4;

// Returns a warning that names the scene and the mesh whose vertices are rounded most, if that
// rounding exceeds kCoarsestVertices; "" otherwise and for scenes without vertices. A compiled
// scene is recentred in double precision, but that does not restore what a file has rounded. If the
// origin follows the camera, the size of what the camera sees replaces the size of the scene, and
// objects out of reach of the camera do not count.
std::string coarseVertices(const Scene& scene, const SceneOrigin& origin);
std::string coarseVertices(const Scene& scene);

}  // namespace restlab
