#include <cmath>
#include <numbers>

#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo coneShape() {
  ShapeInfo info;
  info.summary = "the cone about z from a circle of radius 1 at z = 0 to its tip at z = 1";
  info.parameters = {{"base", 1.0, 0.0, 1.0, "1: closed, 0: the side alone", true}};
  info.examples = {{"cone_open", {0.0f}}};
  info.isConvex = true;
  info.isClosed = [](const ShapeGeometry& shape) { return shape.values[0] > 0.0f; };
  info.isInside = [](const ShapeGeometry&, const glm::dvec3& p) {
    return p.z > 0.0 && std::sqrt(p.x * p.x + p.y * p.y) < 1.0 - p.z;
  };
  info.box = [](const ShapeGeometry&) {
    return std::array{glm::vec3(-1.0f, -1.0f, 0.0f), glm::vec3(1.0f)};
  };
  info.standIn = [](const ShapeGeometry& shape) {
    MeshGeometry mesh = turnedGrid(64, 4, [](float u, float v) {
      const double phi = 2.0 * std::numbers::pi * u, r = 1.0 - double(v);
      return glm::vec3(r * std::cos(phi), r * std::sin(phi), v);
    });
    if (shape.values[0] > 0.0f) addDisk(mesh, 0.0f, true, 64);
    return mesh;
  };
  return info;
}

}  // namespace restlab
