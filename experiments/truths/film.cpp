#include "experiments/truths/film.h"

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

namespace restlab::analytic {

namespace {

struct Node {
  double at, weight;  // on [0, 1]
};

// Gauss-Legendre quadrature.
constexpr std::array<Node, 8> kEight{{{0.01985507175123188, 0.05061426814518813},
                                      {0.10166676129318664, 0.11119051722668724},
                                      {0.2372337950418355, 0.15685332293894363},
                                      {0.4082826787521751, 0.18134189168918100},
                                      {0.5917173212478249, 0.18134189168918100},
                                      {0.7627662049581645, 0.15685332293894363},
                                      {0.8983332387068134, 0.11119051722668724},
                                      {0.9801449282487681, 0.05061426814518813}}};
constexpr std::array<Node, 2> kTwo{{{0.21132486540518712, 0.5}, {0.78867513459481288, 0.5}}};

}  // namespace

const SceneCamera& cameraOf(const Scene& scene, const ExactView& view) {
  return view.moved ? *view.moved : scene.cameras.at(view.camera);
}

glm::dvec3 directionThrough(const SceneCamera& camera, double x, double y, const ExactView& view) {
  const double tangent = std::tan(0.5 * camera.yfov);
  const glm::dvec3 dirL((2.0 * x / view.width - 1.0) * tangent * view.width / view.height,
                        (1.0 - 2.0 * y / view.height) * tangent, -1.0);
  return glm::dmat3(camera.cameraToWorld) * dirL;
}

glm::dvec3 floorPoint(const SceneCamera& camera, const glm::dvec3& dir) {
  const glm::dvec3 origin(camera.cameraToWorld[3]);
  return origin - dir * (origin.y / dir.y);
}

bool seesOnly(const glm::dvec3& low, const glm::dvec3& high, const SceneCamera& camera,
              const ExactView& view) {
  // Checking the corners is enough: the view and the rectangle are convex.
  for (const double x : {0.0, double(view.width)}) {
    for (const double y : {0.0, double(view.height)}) {
      const glm::dvec3 dir = directionThrough(camera, x, y, view);
      if (!(dir.y < 0.0)) return false;
      const glm::dvec3 p = floorPoint(camera, dir);
      if (p.x < low.x || p.x > high.x || p.z < low.z || p.z > high.z) return false;
    }
  }
  return camera.cameraToWorld[3].y > 0.0;
}

std::vector<glm::dvec3> filmOf(const SceneCamera& camera, const ExactView& view, FilmPoints points,
                               const std::function<glm::dvec3(const glm::dvec3& posW)>& radiance) {
  const std::span<const Node> nodes =
      points == FilmPoints::few ? std::span<const Node>(kTwo) : std::span<const Node>(kEight);
  std::vector<glm::dvec3> image(size_t(view.width) * view.height, glm::dvec3(0.0));
  for (uint32_t y = 0; y < view.height; ++y) {
    for (uint32_t x = 0; x < view.width; ++x) {
      glm::dvec3& pixel = image[size_t(y) * view.width + x];
      for (const Node& i : nodes) {
        for (const Node& j : nodes) {
          const glm::dvec3 dir = directionThrough(camera, x + i.at, y + j.at, view);
          pixel += i.weight * j.weight * radiance(floorPoint(camera, dir));
        }
      }
    }
  }
  return image;
}

const MeshInstance& instanceNamed(const Scene& scene, const std::string& name) {
  for (const MeshInstance& instance : scene.instances) {
    if (instance.name == name) return instance;
  }
  throw std::invalid_argument(scene.name + " has no instance '" + name + "'");
}

}  // namespace restlab::analytic
