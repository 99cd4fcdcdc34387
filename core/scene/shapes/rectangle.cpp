#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo rectangleShape() {
  ShapeInfo info;
  info.summary = "the square from (-1, -1) to (1, 1) in the plane z = 0, outside on +z";
  info.isConvex = true;
  info.isFlat = true;
  info.isClosed = [](const ShapeGeometry&) { return false; };
  info.box = [](const ShapeGeometry&) {
    return std::array{glm::vec3(-1.0f, -1.0f, 0.0f), glm::vec3(1.0f, 1.0f, 0.0f)};
  };
  info.standIn = [](const ShapeGeometry&) {
    MeshGeometry mesh;
    mesh.positions = {
        {-1.0f, -1.0f, 0.0f}, {1.0f, -1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {-1.0f, 1.0f, 0.0f}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  };
  return info;
}

}  // namespace restlab
