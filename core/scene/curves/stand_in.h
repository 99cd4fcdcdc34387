// Tubes of triangles that stand in for strands.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// A closed tube of each piece, with normals and texture coordinates if `isFine`. The more pieces,
// the fewer sides it has: 3 at least.
MeshGeometry tubesOf(const std::vector<uint32_t>& words, bool isFine);

}  // namespace restlab
