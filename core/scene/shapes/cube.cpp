#include <algorithm>
#include <cmath>

#include "core/scene/shapes/shape_info.h"

namespace restlab {

ShapeInfo cubeShape() {
  ShapeInfo info;
  info.summary = "the cube from (-1, -1, -1) to (1, 1, 1)";
  info.isConvex = true;
  info.isClosed = [](const ShapeGeometry&) { return true; };
  info.isInside = [](const ShapeGeometry&, const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
  };
  info.box = [](const ShapeGeometry&) { return std::array{glm::vec3(-1.0f), glm::vec3(1.0f)}; };
  info.standIn = [](const ShapeGeometry&) {
    MeshGeometry mesh;
    for (int corner = 0; corner < 8; ++corner)
      mesh.positions.emplace_back((corner & 1) != 0 ? 1.0f : -1.0f,
                                  (corner & 2) != 0 ? 1.0f : -1.0f,
                                  (corner & 4) != 0 ? 1.0f : -1.0f);
    // Two triangles a face, counter-clockwise seen from outside.
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
  };
  return info;
}

}  // namespace restlab
