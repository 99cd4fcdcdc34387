#include "tests/analytic/truths.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "tests/analytic/furnace.h"
#include "tests/analytic/polygon_irradiance.h"

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

// Where the camera sees the plane y = 0.
glm::dvec3 floorPoint(const SceneCamera& camera, double x, double y, uint32_t width,
                      uint32_t height) {
  const double tangent = std::tan(0.5 * camera.yfov);
  const glm::dvec3 dirL((2.0 * x / width - 1.0) * tangent * width / height,
                        (1.0 - 2.0 * y / height) * tangent, -1.0);
  const glm::dvec3 origin(camera.cameraToWorld[3]);
  const glm::dvec3 dir = glm::dmat3(camera.cameraToWorld) * dirL;
  return origin - dir * (origin.y / dir.y);
}

}  // namespace

const std::vector<std::string>& exactSceneNames() {
  static const std::vector<std::string> names{"furnace", "sphere-furnace", "quad-light"};
  return names;
}

glm::dvec3 quadLightRadiance(const Scene& scene, const glm::dvec3& posW) {
  const MeshInstance& light = instanceNamed(scene, "light");
  const MeshInstance& floor = instanceNamed(scene, "floor");
  std::vector<glm::dvec3> corners;
  for (const glm::vec3& p : scene.geometries.at(light.geometry).positions) corners.emplace_back(p);
  const double irradiance = projectedSolidAngle(corners, posW, {0.0, 1.0, 0.0});
  const glm::dvec3 albedo(scene.materials.at(floor.material).data.baseColor);
  const glm::dvec3 radiance(scene.materials.at(light.material).data.emission);
  return albedo / glm::pi<double>() * radiance * std::max(irradiance, 0.0);  // its back is black
}

std::vector<glm::dvec3> exactImage(const Scene& scene, uint32_t width, uint32_t height,
                                   uint32_t scatteringEvents) {
  std::vector<glm::dvec3> image(size_t(width) * height, glm::dvec3(0.0));
  if (scene.name == "furnace") {
    const rl::Material& m = scene.materials.at(0).data;
    const double value = furnaceRadiance(m.emission.x, m.baseColor.x, scatteringEvents);
    image.assign(image.size(), glm::dvec3(value));
    return image;
  }
  if (scene.name == "sphere-furnace" && scatteringEvents > 0) {
    image.assign(image.size(), glm::dvec3(1.0));
    return image;
  }
  if (scene.name != "quad-light") {
    throw std::invalid_argument("no exact image of '" + scene.name + "' at this path length");
  }
  if (scatteringEvents == 0) return image;  // the light is out of view
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      for (size_t i = 0; i < kNodes.size(); ++i) {
        for (size_t j = 0; j < kNodes.size(); ++j) {
          const glm::dvec3 posW =
              floorPoint(scene.cameras.at(0), x + kNodes[i], y + kNodes[j], width, height);
          image[size_t(y) * width + x] +=
              kWeights[i] * kWeights[j] * quadLightRadiance(scene, posW);
        }
      }
    }
  }
  return image;
}

}  // namespace restlab::analytic
