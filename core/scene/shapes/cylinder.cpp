#include <cmath>
#include <numbers>

#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo cylinderShape() {
  ShapeInfo info;
  info.summary = "the cylinder of radius 1 about z, from z = 0 to z = 1";
  info.parameters = {{"ends", 1.0, 0.0, 1.0, "1: closed, 0: the side alone", true}};
  info.examples = {{"cylinder_open", {0.0f}}};
  info.isConvex = true;
  info.isClosed = [](const ShapeGeometry& shape) { return shape.values[0] > 0.0f; };
  info.isInside = [](const ShapeGeometry&, const glm::dvec3& p) {
    return p.x * p.x + p.y * p.y < 1.0 && p.z > 0.0 && p.z < 1.0;
  };
  info.box = [](const ShapeGeometry&) {
    return std::array{glm::vec3(-1.0f, -1.0f, 0.0f), glm::vec3(1.0f)};
  };
  info.standIn = [](const ShapeGeometry& shape) {
    MeshGeometry mesh = turnedGrid(64, 1, [](float u, float v) {
      const double phi = 2.0 * std::numbers::pi * u;
      return glm::vec3(std::cos(phi), std::sin(phi), v);
    });
    if (shape.values[0] > 0.0f) {
      addDisk(mesh, 0.0f, true, 64);
      addDisk(mesh, 1.0f, false, 64);
    }
    return mesh;
  };
  return info;
}

}  // namespace restlab
