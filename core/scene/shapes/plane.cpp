#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo planeShape() {
  ShapeInfo info;
  info.summary = "the plane z = 0, out to a size, outside on +z; gives no light";
  info.parameters = {{"size", 1e4, 1.0, 1e6, "largest |x| and |y|"}};
  info.examples = {{"plane_small", {1.0f}}, {"plane_large", {1e6f}}};
  info.isConvex = true;
  info.isFlat = true;
  info.hasDraws = false;
  info.isClosed = [](const ShapeGeometry&) { return false; };
  info.box = [](const ShapeGeometry& shape) {
    const float size = shape.values[0];
    return std::array{glm::vec3(-size, -size, 0.0f), glm::vec3(size, size, 0.0f)};
  };
  info.standIn = [](const ShapeGeometry& shape) {
    const float size = shape.values[0];
    MeshGeometry mesh;
    for (const glm::vec2& c : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      mesh.positions.emplace_back(size * c, 0.0f);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  };
  return info;
}

}  // namespace restlab
