// Non-uniform rational B-spline surfaces in double precision. Bezier surfaces and B-splines without
// weights are special cases. Trimming curves are not supported.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace restlab {

constexpr int kMostSplineDegree = 7;
constexpr int kMostSplinePoints = 1024;  // along one direction

// One direction of a surface.
struct SplineAxis {
  int degree = 3;
  int count = 4;              // of control points
  std::vector<double> knots;  // count + degree + 1 numbers that do not decrease
};

struct NurbsSurface {
  SplineAxis u, v;
  std::vector<glm::dvec3> points;  // u.count * v.count, u runs fastest
  std::vector<double> weights;     // one a point
};

// A point of a surface. The normal is along cross(du, dv). At an edge that is one point it is the
// limit from inside the surface.
struct SplinePoint {
  glm::dvec3 position{0.0}, du{0.0}, dv{0.0}, normal{0.0, 0.0, 1.0};
};

struct SplineFault {
  std::string key;  // degree, size, knots_u, knots_v, points, weights
  std::string message;
};
// The first fault of a surface, and what would be right.
std::optional<SplineFault> faultOf(const NurbsSurface& surface);

// Knots of a curve that begins and ends in its first and last point, the rest at equal distances
// from 0 to 1.
std::vector<double> clampedKnots(int degree, int count);

// First and last parameter: knots[degree] and knots[count].
std::array<double, 2> domainOf(const SplineAxis& axis);

// Evaluates by basis functions. u and v lie in the domain.
SplinePoint evaluate(const NurbsSurface& surface, double u, double v);

// The unit sphere about the origin, poles on z, exact: eight rational pieces of degree 2. u runs
// around z from x to y, v from the pole on -z up.
NurbsSurface sphereAsNurbs();

}  // namespace restlab
