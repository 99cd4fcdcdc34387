#include "tests/scene/mesh_checks.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace restlab::test {

std::vector<WorldTriangle> worldTriangles(const Scene& scene, const std::string& prefix) {
  std::vector<WorldTriangle> all;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    if (instance.name.compare(0, prefix.size(), prefix) != 0) continue;
    const MeshGeometry& mesh = scene.geometries.at(instance.geometry);
    const auto corner = [&](uint32_t index) {
      return glm::dvec3(instance.objectToWorld *
                        glm::dvec4(glm::dvec3(mesh.positions.at(index)), 1.0));
    };
    for (const glm::uvec3& t : mesh.triangles) {
      all.push_back({corner(t.x), corner(t.y), corner(t.z), i});
    }
  }
  return all;
}

std::string openEdge(const std::vector<WorldTriangle>& triangles) {
  using Point = std::array<double, 3>;
  std::map<std::pair<Point, Point>, int> balance;
  const auto key = [](const glm::dvec3& p) { return Point{p.x, p.y, p.z}; };
  for (const WorldTriangle& t : triangles) {
    const std::array<Point, 3> corner{key(t.p0), key(t.p1), key(t.p2)};
    for (size_t i = 0; i < 3; ++i) {
      const Point &a = corner[i], &b = corner[(i + 1) % 3];
      if (a < b) {
        ++balance[{a, b}];
      } else {
        --balance[{b, a}];
      }
    }
  }
  for (const auto& [edge, count] : balance) {
    if (count == 0) continue;
    const auto& [a, b] = edge;
    return fmt::format("({}, {}, {}) - ({}, {}, {})", a[0], a[1], a[2], b[0], b[1], b[2]);
  }
  return "";
}

double signedVolume(const std::vector<WorldTriangle>& triangles) {
  double volume = 0.0;
  for (const WorldTriangle& t : triangles) {
    volume += glm::dot(t.p0, glm::cross(t.p1, t.p2)) / 6.0;
  }
  return volume;
}

std::optional<WorldHit> nearestHit(const std::vector<WorldTriangle>& triangles,
                                   const glm::dvec3& origin, const glm::dvec3& dir) {
  std::optional<WorldHit> nearest;
  for (const WorldTriangle& t : triangles) {
    const glm::dvec3 e1 = t.p1 - t.p0, e2 = t.p2 - t.p0;
    const glm::dvec3 p = glm::cross(dir, e2);
    const double det = glm::dot(e1, p);
    if (det == 0.0) continue;
    const glm::dvec3 s = origin - t.p0;
    const double u = glm::dot(s, p) / det;
    if (u < 0.0 || u > 1.0) continue;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(dir, q) / det;
    if (v < 0.0 || u + v > 1.0) continue;
    const double distance = glm::dot(e2, q) / det;
    if (distance > 0.0 && (!nearest || distance < nearest->t)) nearest = WorldHit{distance, &t};
  }
  return nearest;
}

glm::dvec3 cameraDirection(const SceneCamera& camera, double x, double y, double aspect) {
  const double tangent = std::tan(0.5 * camera.yfov);
  const glm::dvec3 dirL((2.0 * x - 1.0) * tangent * aspect, (1.0 - 2.0 * y) * tangent, -1.0);
  return glm::dmat3(camera.cameraToWorld) * dirL;
}

const MeshInstance& instanceNamed(const Scene& scene, const std::string& name) {
  for (const MeshInstance& instance : scene.instances) {
    if (instance.name == name) return instance;
  }
  throw std::invalid_argument(scene.name + " has no instance '" + name + "'");
}

}  // namespace restlab::test
