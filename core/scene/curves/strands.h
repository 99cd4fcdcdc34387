// Strands of hair, fibres and wires: splines of points with radii, cut into round cones, each the
// hull of two spheres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace restlab {

enum class StrandBasis { linear, bezier, bspline, catmullRom };
// In the order of StrandBasis, as files name them.
const std::vector<std::string>& strandBases();

struct Strands {
  StrandBasis basis = StrandBasis::bspline;
  std::vector<glm::dvec4> points;  // of all strands: place, radius
  std::vector<size_t> counts;      // points of each strand
};

constexpr double kMostStrandCoordinate = 1e9;
// Default of cutStrands().
constexpr double kStrandError = 0.01;
constexpr size_t kMostStrandPoints = size_t{1} << 24;
constexpr size_t kMostStrandPieces = size_t{1} << 22;

// Line that says what is wrong with a number of points of one strand; "" if it is right.
std::string faultOfCount(StrandBasis basis, size_t count);
// Line that says what is wrong with a point; "" if it is right.
std::string faultOfPoint(const glm::dvec4& point);

struct StrandPiece {
  glm::vec4 start, end;  // centre and radius of its spheres; equal: one sphere
  glm::vec3 across;      // unit, away from the axis; turns as little as the strand allows
  glm::vec2 v;           // place along the strand of both spheres, 0 to 1
};

// Cuts all strands. Their pieces are at most `error` times the radius off the splines, in place and
// radius together. Throws Error (badInput): more than kMostStrandPieces, a radius that vanishes
// between two points, one that is too thin for single precision where it is.
std::vector<StrandPiece> cutStrands(const Strands& strands, double error);

}  // namespace restlab
