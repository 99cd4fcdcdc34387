// A surface as core/geometry/shapes/nurbs.glsl reads it. Its Bezier pieces are cut until each is
// flat enough for Newton's method, all of one column alike and all of one row. Words, in uvec4s:
//   0       columns, rows, degree along u, degree along v
//   1       largest coordinate along each axis; number of the uvec4 with the first piece
//   2 k     lower corner of the box of node k, its piece (column + row * columns) or RL_INVALID
//   2 k + 1 upper corner; which edge of the piece is one point (1: s = 0, 2: s = 1, 3: t = 0, 4: t
//   = 1)
//           or 0; node 1 is the root, 2 k and 2 k + 1 are the children of node k
//   pieces  origin, largest distance of the net from it
//           normal, sine of the angle between a ray and the tangent plane of the normal beyond
//           which the ray meets the piece once at most texture coordinates at its corners: u0, v0,
//           u1, v1 net: weight * (point - origin), weight; u runs fastest
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/splines/bezier.h"

namespace restlab {

constexpr size_t kMostSurfacePieces = size_t{1} << 15;

// Throws Error (badInput) if a surface needs more than kMostSurfacePieces pieces.
std::vector<uint32_t> surfaceWords(const BezierGrid& grid);

// The pieces of such words, for the host.
BezierGrid surfaceOfWords(const std::vector<uint32_t>& words);
// The box of the root.
std::array<glm::vec3, 2> boxOfWords(const std::vector<uint32_t>& words);

}  // namespace restlab
