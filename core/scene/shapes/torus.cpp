#include <cmath>
#include <numbers>

#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo torusShape() {
  ShapeInfo info;
  info.summary = "the torus about z, along the unit circle in the plane z = 0";
  info.parameters = {{"minor", 0.25, 0.01, 0.99, "radius of the tube"}};
  info.examples = {{"torus_thin", {0.02f}}, {"torus_fat", {0.95f}}};
  info.isClosed = [](const ShapeGeometry&) { return true; };
  info.isInside = [](const ShapeGeometry& shape, const glm::dvec3& p) {
    const double fromCircle = std::hypot(p.x, p.y) - 1.0;
    return std::hypot(fromCircle, p.z) < double(shape.values[0]);
  };
  info.box = [](const ShapeGeometry& shape) {
    const float r = shape.values[0], reach = 1.0f + r;
    return std::array{glm::vec3(-reach, -reach, -r), glm::vec3(reach, reach, r)};
  };
  info.standIn = [](const ShapeGeometry& shape) {
    const double r = double(shape.values[0]);
    return turnedGrid(64, 32, [r](float u, float v) {
      const double phi = 2.0 * std::numbers::pi * u, theta = 2.0 * std::numbers::pi * v;
      const double rho = 1.0 + r * std::cos(theta);
      return glm::vec3(rho * std::cos(phi), rho * std::sin(phi), r * std::sin(theta));
    });
  };
  return info;
}

}  // namespace restlab
