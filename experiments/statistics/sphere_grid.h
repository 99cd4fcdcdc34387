// A partition of the sphere of directions into cells, and integrals over them by quadrature: the
// expected side of chi-squared tests, and numeric albedos.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace restlab::stats {

class SphereGrid {
 public:
  // Concentration of a density: a unit direction and an angular width in radians.
  struct Peak {
    glm::dvec3 direction;
    double width;
  };

  // Cells are products of intervals of polar angle (from +z; the horizon is always an edge) and
  // azimuth: a coarse uniform grid, refined geometrically around each peak.
  explicit SphereGrid(const std::vector<Peak>& peaks = {});

  size_t size() const { return (thetas_.size() - 1) * (phis_.size() - 1); }
  // Cell of a unit direction; nullopt if it is not finite.
  std::optional<size_t> find(const glm::dvec3& direction) const;

  // Returns whether the cell lies below the horizon (z < 0).
  bool isBelow(size_t cell) const;

  // Integral over solid angle of a vector function, per cell: adaptive Gauss quadrature. The error
  // of a cell is below 1e-7 + 1e-4 of its value for smooth functions, about 1e-3 of the value if a
  // discontinuity crosses the cell.
  using Function = std::function<glm::dvec4(const glm::dvec3&)>;
  std::vector<glm::dvec4> integrate(const Function& f) const;
  // Integral over one cell, always split into at least 4^depth parts: finds slivers that the first
  // points of integrate() missed.
  glm::dvec4 integrateCell(size_t cell, const Function& f, int depth) const;

 private:
  std::vector<double> thetas_, phis_;  // edges; azimuth from -pi to pi
};

// Gauss-Legendre abscissae and weights of five points on [-1, 1].
inline constexpr double kGauss5X[5] = {-0.906179845938664, -0.538469310105683, 0.0,
                                       0.538469310105683, 0.906179845938664};
inline constexpr double kGauss5W[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                       0.478628670499366, 0.236926885056189};

}  // namespace restlab::stats
