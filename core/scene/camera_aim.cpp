// pointLookedAt(): the scene's triangles one by one, in double precision. It is asked for once a
// path, before anything is rendered, and so needs no hierarchy.
#include <limits>

#include "core/scene/camera_path.h"

namespace restlab {

namespace {

// The distance, in lengths of `dir`, at which a ray from `origin` meets a triangle from either
// side; infinite where it does not. (Moeller & Trumbore 1997.)
double distanceTo(const glm::dvec3& origin, const glm::dvec3& dir, const glm::dvec3& a,
                  const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const glm::dvec3 edge1 = b - a, edge2 = c - a, across = glm::cross(dir, edge2);
  const double determinant = glm::dot(edge1, across);
  if (determinant == 0.0) return kNone;
  const glm::dvec3 offset = origin - a;
  const double u = glm::dot(offset, across) / determinant;
  const glm::dvec3 turned = glm::cross(offset, edge1);
  const double v = glm::dot(dir, turned) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return kNone;
  const double t = glm::dot(edge2, turned) / determinant;
  return t > 0.0 ? t : kNone;
}

// Along the axis of the view, in metres; infinite where it meets nothing.
double distanceToSurface(const Scene& scene, const glm::dvec3& originW, const glm::dvec3& dirW) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MeshInstance& instance : scene.instances) {
    const MeshGeometry& geometry = scene.geometries[instance.geometry];
    const auto corner = [&](uint32_t index) {
      return glm::dvec3(instance.objectToWorld * glm::dvec4(geometry.positions[index], 1.0));
    };
    for (const glm::uvec3& triangle : geometry.triangles) {
      nearest = std::min(nearest, distanceTo(originW, dirW, corner(triangle.x), corner(triangle.y),
                                             corner(triangle.z)));
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
