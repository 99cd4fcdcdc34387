#include "core/scene/plate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dialect/math.h"
#include "core/scene/linear_map.h"

namespace restlab {

glm::dmat4 withThickness(const glm::dmat4& toWorld, const MeshGeometry& mesh) {
  const glm::dmat3 linear(toWorld);
  const Flatness flatness = flatnessOf(linear);
  if (!(flatness.ratio < kSmallestRegularity) || mesh.positions.empty()) return toWorld;
  double low = std::numeric_limits<double>::infinity(), high = -low, coordinate = 0.0;
  for (const glm::vec3& p : mesh.positions) {
    const double along = glm::dot(flatness.lost, glm::dvec3(p));
    low = std::min(low, along);
    high = std::max(high, along);
    const glm::dvec3 at(toWorld * glm::dvec4(p, 1.0));
    coordinate = std::max({coordinate, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
  }
  constexpr double kOffsets = 8.0;
  const double thickness = kOffsets * double(rl::RL_HIT_ERROR) * coordinate;
  // A mesh that is itself flat along `lost` has a single side and needs no thickness: just make the
  // map regular.
  const double wanted = high > low ? thickness / (high - low) : flatness.inPlane;
  const double stretch = flatness.stretch < 0.0 ? -wanted : wanted;
  glm::dmat4 thick(withStretch(linear, flatness, stretch));
  const double middle = 0.5 * (low + high) * (stretch - flatness.stretch);
  thick[3] = toWorld[3] - glm::dvec4(middle * flatness.normal, 0.0);
  return thick;
}

}  // namespace restlab
