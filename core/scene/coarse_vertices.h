// Vertices so far from their origin that float32 rounds them visibly.
#pragma once

#include <string>

#include "core/scene/scene_origin.h"

namespace restlab {

// Largest spacing of float32 numbers at a vertex, over the size of the scene, without a line.
// docs/manual.md has what was measured on both sides.
constexpr double kCoarsestVertices = 1e-4;

// A line that names the scene and the mesh whose vertices are rounded most, where that is more than
// kCoarsestVertices; "" elsewhere and of scenes without vertices. A compiled scene is recentred in
// double precision, but what a file has rounded before is lost. Where the origin follows the
// camera, what the camera sees takes the place of the scene, and objects out of its reach do not
// count.
std::string coarseVertices(const Scene& scene, const SceneOrigin& origin);
std::string coarseVertices(const Scene& scene);

}  // namespace restlab
