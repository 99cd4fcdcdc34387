#include <cmath>
#include <numbers>

#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo sphereShape() {
  ShapeInfo info;
  info.summary = "the unit sphere, poles on z";
  info.isConvex = true;
  info.isClosed = [](const ShapeGeometry&) { return true; };
  info.isInside = [](const ShapeGeometry&, const glm::dvec3& p) { return glm::dot(p, p) < 1.0; };
  info.box = [](const ShapeGeometry&) { return std::array{glm::vec3(-1.0f), glm::vec3(1.0f)}; };
  info.standIn = [](const ShapeGeometry&) {
    return turnedGrid(32, 16, [](float u, float v) {
      const double phi = 2.0 * std::numbers::pi * u, theta = std::numbers::pi * (1.0 - double(v));
      const double ring = v == 0.0f || v == 1.0f ? 0.0 : std::sin(theta);
      return glm::vec3(ring * std::cos(phi), ring * std::sin(phi), std::cos(theta));
    });
  };
  return info;
}

}  // namespace restlab
