// Strands as core/geometry/shapes/curves.glsl reads them. Words, in uvec4s:
//   0       number of the first leaf; number of the uvec4 with the first piece; number of pieces
//   2 k     lower corner of the box of node k; first piece of a leaf
//   2 k + 1 upper corner; the piece behind the last of a leaf
//           node 1 is the root, 2 k and 2 k + 1 are the children of node k, all leaves are on one
//           level
//   pieces  centre and radius of the first sphere, the same of the second
//           direction where u begins (octahedral), v of both spheres
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/curves/strands.h"

namespace restlab {

std::vector<uint32_t> curveWords(std::vector<StrandPiece> pieces);

// For the host; the order of pieces is that of the words.
size_t curvePieces(const std::vector<uint32_t>& words);
StrandPiece curvePiece(const std::vector<uint32_t>& words, size_t piece);
// The box of the root.
std::array<glm::vec3, 2> boxOfCurves(const std::vector<uint32_t>& words);
// Returns whether a point is within a piece.
bool isInCurves(const std::vector<uint32_t>& words, const glm::dvec3& posL);

// Signed distance to a piece, below 0 inside.
double distanceTo(const StrandPiece& piece, const glm::dvec3& posL);

}  // namespace restlab
