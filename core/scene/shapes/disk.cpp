#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo diskShape() {
  ShapeInfo info;
  info.summary = "the unit disk in the plane z = 0, outside on +z";
  info.isConvex = true;
  info.isFlat = true;
  info.isClosed = [](const ShapeGeometry&) { return false; };
  info.box = [](const ShapeGeometry&) {
    return std::array{glm::vec3(-1.0f, -1.0f, 0.0f), glm::vec3(1.0f, 1.0f, 0.0f)};
  };
  info.standIn = [](const ShapeGeometry&) {
    MeshGeometry mesh;
    addDisk(mesh, 0.0f, false, 64);
    return mesh;
  };
  return info;
}

}  // namespace restlab
