// Rational Bezier pieces of a surface.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/splines/nurbs.h"

namespace restlab {

struct BezierPiece {
  int degreeU = 3, degreeV = 3;
  std::vector<glm::dvec4> net;  // (weight * point, weight), u runs fastest
};

// Pieces between the different knots of a surface.
struct BezierGrid {
  std::vector<double> linesU, linesV;  // parameters at the edges of the pieces
  std::vector<BezierPiece> pieces;     // u runs fastest
  size_t columns() const { return linesU.size() - 1; }
  size_t rows() const { return linesV.size() - 1; }
};

// Inserts knots until every piece has a net of its own. The surface stays the same; neighbours
// share the control points of their edge, to the last bit.
BezierGrid bezierGrid(const NurbsSurface& surface);

// A parameter in [0, 1] with its difference from 1: curves read from either end are the same to the
// last bit.
struct UnitParameter {
  double at = 0.0, rest = 1.0;
};
inline UnitParameter fraction(size_t i, size_t n) {
  return {double(i) / double(n), double(n - i) / double(n)};
}

// Derivatives are along s and t of the piece.
SplinePoint evaluate(const BezierPiece& piece, UnitParameter s, UnitParameter t);

// The part of a piece between two parameters along u and v, as a piece.
BezierPiece part(const BezierPiece& piece, double s0, double s1, double t0, double t1);

}  // namespace restlab
