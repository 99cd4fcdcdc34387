// pointLookedAt(): tests the scene's triangles one by one, in double precision. No hierarchy is
// needed: it runs once per path, before rendering.
#include <algorithm>
#include <limits>

#include "core/scene/camera_path/camera_path.h"
#include "core/scene/ray_triangle.h"

namespace restlab {

namespace {

// Distance along the view axis in metres; infinite if the axis meets no surface.
double distanceToSurface(const Scene& scene, const glm::dvec3& originW, const glm::dvec3& dirW) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& geometry = scene.geometries[instance.geometry];
    const auto corner = [&](uint32_t index) {
      return glm::dvec3(instance.objectToWorld * glm::dvec4(geometry.positions[index], 1.0));
    };
    for (const glm::uvec3& triangle : geometry.triangles) {
      nearest = std::min(nearest, distanceToTriangle(originW, dirW, corner(triangle.x),
                                                     corner(triangle.y), corner(triangle.z)));
    }
  }
  return nearest;
}

}  // namespace

glm::dvec3 pointLookedAt(const Scene& scene, const SceneCamera& camera) {
  const glm::dvec3 originW(camera.cameraToWorld[3]);
  const glm::dvec3 dirW = -glm::normalize(glm::dvec3(camera.cameraToWorld[2]));
  const double distance = distanceToSurface(scene, originW, dirW);
  if (distance < std::numeric_limits<double>::infinity()) return originW + dirW * distance;
  const std::array<glm::dvec3, 2> bounds = worldBounds(scene);
  const double ahead = glm::dot(0.5 * (bounds[0] + bounds[1]) - originW, dirW);
  if (ahead > 0.0) return originW + dirW * ahead;
  const double size = glm::length(bounds[1] - bounds[0]);
  return originW + dirW * (size > 0.0 ? size : 1.0);
}

}  // namespace restlab
