#include "experiments/truths/truths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "core/scene/compiled_scene.h"
#include "experiments/truths/furnace.h"
#include "experiments/truths/polygon_irradiance.h"

namespace restlab::analytic {
namespace {

// Nodes and weights of 8-point Gauss-Legendre quadrature on [0, 1].
constexpr std::array<double, 8> kNodes{0.01985507175123188, 0.10166676129318664, 0.2372337950418355,
                                       0.4082826787521751,  0.5917173212478249,  0.7627662049581645,
                                       0.8983332387068134,  0.9801449282487681};
constexpr std::array<double, 8> kWeights{
    0.05061426814518813, 0.11119051722668724, 0.15685332293894363, 0.18134189168918100,
    0.18134189168918100, 0.15685332293894363, 0.11119051722668724, 0.05061426814518813};

const MeshInstance& instanceNamed(const Scene& scene, const std::string& name) {
  for (const MeshInstance& instance : scene.instances) {
    if (instance.name == name) return instance;
  }
  throw std::invalid_argument(scene.name + " has no instance '" + name + "'");
}

// A direction in which the camera sees a place of its film.
glm::dvec3 directionThrough(const SceneCamera& camera, double x, double y, const ExactView& view) {
  const double tangent = std::tan(0.5 * camera.yfov);
  const glm::dvec3 dirL((2.0 * x / view.width - 1.0) * tangent * view.width / view.height,
                        (1.0 - 2.0 * y / view.height) * tangent, -1.0);
  return glm::dmat3(camera.cameraToWorld) * dirL;
}

// Where it meets the plane y = 0.
glm::dvec3 floorPoint(const SceneCamera& camera, const glm::dvec3& dir) {
  const glm::dvec3 origin(camera.cameraToWorld[3]);
  return origin - dir * (origin.y / dir.y);
}

std::vector<glm::dvec3> cornersOf(const Scene& scene, const std::string& instance) {
  std::vector<glm::dvec3> corners;
  for (const glm::vec3& p : scene.geometries.at(instanceNamed(scene, instance).geometry).positions)
    corners.emplace_back(p);
  return corners;
}

// Is all of it beyond one of the four sides of what the camera sees?
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

// The polygon formula gives the floor's radiance; the picture must show floor alone, on the side of
// the light to which it shines.
std::string whyNotQuadLight(const Scene& scene, const ExactView& view) {
  const SceneCamera& camera = scene.cameras.at(view.camera);
  const std::vector<glm::dvec3> light = cornersOf(scene, "light"),
                                floor = cornersOf(scene, "floor");
  glm::dvec3 low(floor.front()), high(floor.front());
  for (const glm::dvec3& p : floor) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 normal = glm::cross(light[1] - light[0], light[3] - light[0]);
  const auto isInFront = [&](const glm::dvec3& p) { return glm::dot(normal, p - light[0]) > 0.0; };
  // What lies between its corners and the eye is as they are: all of it is convex.
  for (const double x : {0.0, double(view.width)}) {
    for (const double y : {0.0, double(view.height)}) {
      const glm::dvec3 dir = directionThrough(camera, x, y, view);
      const glm::dvec3 p = floorPoint(camera, dir);
      const bool isOnFloor =
          dir.y < 0.0 && p.x >= low.x && p.x <= high.x && p.z >= low.z && p.z <= high.z;
      if (!isOnFloor) return "from a camera that sees more than the floor";
      if (!isInFront(p)) return "of a floor behind the light";
    }
  }
  const bool isClear = isInFront(glm::dvec3(camera.cameraToWorld[3]));
  if (!isClear && !isOutOfView(light, camera, view)) return "from a camera that sees the light";
  return "";
}

std::string baseOf(const Scene& scene) { return scene.name.substr(0, scene.name.find('?')); }

}  // namespace

const std::vector<std::string>& exactSceneNames() {
  static const std::vector<std::string> names{"furnace", "sphere-furnace", "quad-light"};
  return names;
}

glm::dvec3 quadLightRadiance(const Scene& scene, const glm::dvec3& posW) {
  const MeshInstance& light = instanceNamed(scene, "light");
  const MeshInstance& floor = instanceNamed(scene, "floor");
  const double irradiance = projectedSolidAngle(cornersOf(scene, "light"), posW, {0.0, 1.0, 0.0});
  const glm::dvec3 albedo(scene.materials.at(floor.material).data.baseColor);
  const glm::dvec3 radiance(scene.materials.at(light.material).data.emission);
  return albedo / glm::pi<double>() * radiance * std::max(irradiance, 0.0);  // its back is black
}

std::string whyNotExact(const Scene& scene, const ExactView& view) {
  const std::string base = baseOf(scene);
  const auto& names = exactSceneNames();
  if (!scene.source.empty() || std::find(names.begin(), names.end(), base) == names.end()) {
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    return "(scenes that have one: " + known + ")";
  }
  if (base == "sphere-furnace") {
    if (view.scatteringEvents == 0) return "at 0 scattering events";
    const rl::Material& material = scene.materials.at(0).data;
    const bool isRough = material.metallic > 0.0f && hasRoughReflection(scene);
    if (isRough && !view.multiscatter) return "of rough metal without multiscatter = true";
  }
  return base == "quad-light" ? whyNotQuadLight(scene, view) : "";
}

std::vector<glm::dvec3> exactImage(const Scene& scene, const ExactView& view) {
  const std::string why = whyNotExact(scene, view);
  if (!why.empty()) throw std::invalid_argument("no exact image of '" + scene.name + "' " + why);
  const size_t pixels = size_t(view.width) * view.height;
  const std::string base = baseOf(scene);
  if (base == "furnace") {
    const rl::Material& m = scene.materials.at(0).data;
    const double value =
        furnaceRadiance(double(m.emission.x), double(m.baseColor.x), view.scatteringEvents);
    return std::vector<glm::dvec3>(pixels, glm::dvec3(value));
  }
  if (base == "sphere-furnace") return std::vector<glm::dvec3>(pixels, glm::dvec3(1.0));
  std::vector<glm::dvec3> image(pixels, glm::dvec3(0.0));
  if (view.scatteringEvents == 0) return image;  // the light is out of view
  const SceneCamera& camera = scene.cameras.at(view.camera);
  for (uint32_t y = 0; y < view.height; ++y) {
    for (uint32_t x = 0; x < view.width; ++x) {
      for (size_t i = 0; i < kNodes.size(); ++i) {
        for (size_t j = 0; j < kNodes.size(); ++j) {
          const glm::dvec3 dir = directionThrough(camera, x + kNodes[i], y + kNodes[j], view);
          image[size_t(y) * view.width + x] +=
              kWeights[i] * kWeights[j] * quadLightRadiance(scene, floorPoint(camera, dir));
        }
      }
    }
  }
  return image;
}

}  // namespace restlab::analytic
