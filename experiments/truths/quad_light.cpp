#include "experiments/truths/quad_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "experiments/truths/film.h"
#include "experiments/truths/polygon_irradiance.h"

namespace restlab::analytic {
namespace {

struct Emitter {
  std::vector<glm::dvec3> corners;
  glm::dvec3 radiance;
};

// Returns the corners of a mesh of one polygon, or of a square grid.
std::vector<glm::dvec3> outline(const MeshGeometry& mesh) {
  std::vector<glm::dvec3> p(mesh.positions.begin(), mesh.positions.end());
  if (p.size() <= 4) return p;
  const size_t row = size_t(std::lround(std::sqrt(double(p.size()))));
  return {p.front(), p[row - 1], p.back(), p[p.size() - row]};
}

std::vector<glm::dvec3> cornersOf(const Scene& scene, const std::string& instance) {
  return outline(scene.geometries.at(instanceNamed(scene, instance).geometry));
}

glm::dvec3 emissionOf(const Scene& scene, const MeshInstance& instance) {
  const SceneMaterial& material = scene.materials.at(instance.material);
  return glm::dvec3(material.data.emission) * double(material.lightFactor);
}

// Returns the rectangle as if uniform, and the excess of its brightest triangle.
std::vector<Emitter> emittersOf(const Scene& scene) {
  const MeshInstance& light = instanceNamed(scene, "light");
  std::vector<Emitter> all = {{cornersOf(scene, "light"), emissionOf(scene, light)}};
  for (const MeshInstance& instance : scene.instances) {
    if (instance.name == "brightest")
      all.push_back(
          {cornersOf(scene, "brightest"), emissionOf(scene, instance) - all.front().radiance});
  }
  return all;
}

// Returns whether all points are beyond one of the four sides of the view.
bool isOutOfView(const std::vector<glm::dvec3>& points, const SceneCamera& camera,
                 const ExactView& view) {
  const double vertical = std::tan(0.5 * camera.yfov);
  const double horizontal = vertical * view.width / view.height;
  const glm::dmat4 toCamera = glm::inverse(camera.cameraToWorld);
  std::array<bool, 4> isBeyond{true, true, true, true};
  for (const glm::dvec3& posW : points) {
    const glm::dvec3 p(toCamera * glm::dvec4(posW, 1.0));
    isBeyond[0] = isBeyond[0] && p.x > -p.z * horizontal;
    isBeyond[1] = isBeyond[1] && -p.x > -p.z * horizontal;
    isBeyond[2] = isBeyond[2] && p.y > -p.z * vertical;
    isBeyond[3] = isBeyond[3] && -p.y > -p.z * vertical;
  }
  return std::any_of(isBeyond.begin(), isBeyond.end(), [](bool beyond) { return beyond; });
}

glm::dvec3 radianceOf(const std::vector<Emitter>& emitters, const glm::dvec3& albedo,
                      const glm::dvec3& posW) {
  glm::dvec3 sum(0.0);
  for (const Emitter& e : emitters) {
    const double irradiance = projectedSolidAngle(e.corners, posW, {0.0, 1.0, 0.0});
    sum += e.radiance * std::max(irradiance, 0.0);  // the back is black
  }
  return albedo / glm::pi<double>() * sum;
}

glm::dvec3 albedoOf(const Scene& scene) {
  return glm::dvec3(scene.materials.at(instanceNamed(scene, "floor").material).data.baseColor);
}

}  // namespace

glm::dvec3 quadLightRadiance(const Scene& scene, const glm::dvec3& posW) {
  return radianceOf(emittersOf(scene), albedoOf(scene), posW);
}

// The polygon formula gives the radiance of the floor. The view must show only floor, on the side
// that the light shines on.
std::string whyNotQuadLight(const Scene& scene, const ExactView& view) {
  const SceneCamera& camera = cameraOf(scene, view);
  const std::vector<glm::dvec3> light = cornersOf(scene, "light"),
                                floor = cornersOf(scene, "floor");
  glm::dvec3 low(floor.front()), high(floor.front());
  for (const glm::dvec3& p : floor) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (!seesOnly(low, high, camera, view)) return "from a camera that sees more than the floor";
  const glm::dvec3 normal = glm::cross(light[1] - light[0], light[3] - light[0]);
  const auto isInFront = [&](const glm::dvec3& p) { return glm::dot(normal, p - light[0]) > 0.0; };
  for (const double x : {0.0, double(view.width)}) {
    for (const double y : {0.0, double(view.height)}) {
      if (!isInFront(floorPoint(camera, directionThrough(camera, x, y, view))))
        return "of a floor behind the light";
    }
  }
  const bool isClear = isInFront(glm::dvec3(camera.cameraToWorld[3]));
  if (!isClear && !isOutOfView(light, camera, view)) return "from a camera that sees the light";
  return "";
}

std::vector<glm::dvec3> quadLightImage(const Scene& scene, const ExactView& view) {
  if (view.scatteringEvents == 0)  // the light is out of view
    return std::vector<glm::dvec3>(size_t(view.width) * view.height, glm::dvec3(0.0));
  const std::vector<Emitter> emitters = emittersOf(scene);
  const glm::dvec3 albedo = albedoOf(scene);
  return filmOf(cameraOf(scene, view), view, FilmPoints::many,
                [&](const glm::dvec3& posW) { return radianceOf(emitters, albedo, posW); });
}

}  // namespace restlab::analytic
