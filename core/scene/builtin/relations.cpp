#include "core/scene/builtin/relations.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

namespace restlab::builtin {

namespace {

glm::vec3 times(const glm::vec3& v, double factor) { return glm::vec3(glm::dvec3(v) * factor); }

}  // namespace

void scaleScene(Scene& scene, double factor) {
  for (MeshGeometry& geometry : scene.geometries) {
    if (geometry.shape != nullptr) continue;  // its size is that of its instances
    for (glm::vec3& position : geometry.positions) position = times(position, factor);
  }
  for (MeshInstance& instance : scene.instances) {
    if (scene.geometries[instance.geometry].shape != nullptr) {
      for (int c = 0; c < 3; ++c) instance.objectToWorld[c] *= factor;
    }
    instance.objectToWorld[3] = glm::dvec4(glm::dvec3(instance.objectToWorld[3]) * factor, 1.0);
  }
  for (SceneMaterial& material : scene.materials) {
    material.data.sigmaAbsorption = times(material.data.sigmaAbsorption, 1.0 / factor);
    material.sigmaScattering = times(material.sigmaScattering, 1.0 / factor);
  }
  for (SceneCamera& camera : scene.cameras) {
    camera.cameraToWorld[3] = glm::dvec4(glm::dvec3(camera.cameraToWorld[3]) * factor, 1.0);
    camera.xmag *= factor;
    camera.ymag *= factor;
  }
  for (PunctualLight& light : scene.lights) {
    light.posW *= factor;
    // W/sr scales with the square of lengths; W/m^2 of a directional light does not scale.
    if (light.kind != rl::RL_LIGHT_DIRECTIONAL)
      light.intensity = times(light.intensity, factor * factor);
  }
}

void multiplyRadiance(Scene& scene, double factor) {
  for (SceneMaterial& material : scene.materials)
    material.data.emission = times(material.data.emission, factor);
  for (PunctualLight& light : scene.lights) light.intensity = times(light.intensity, factor);
  if (scene.environment)
    scene.environment->scale = static_cast<float>(scene.environment->scale * factor);
}

void moveScene(Scene& scene, double sizes) {
  const auto bounds = worldBounds(scene);
  const glm::dvec3 extent = bounds[1] - bounds[0];
  const glm::dvec3 offset(sizes * std::max({extent.x, extent.y, extent.z}));
  std::vector<bool> isInWorldSpace(scene.geometries.size(), true);
  for (const MeshInstance& instance : scene.instances) {
    if (instance.objectToWorld != glm::dmat4(1.0) ||
        scene.geometries[instance.geometry].shape != nullptr)
      isInWorldSpace[instance.geometry] = false;
  }
  for (size_t g = 0; g < scene.geometries.size(); ++g) {
    if (!isInWorldSpace[g]) continue;
    for (glm::vec3& position : scene.geometries[g].positions)
      position = glm::vec3(glm::dvec3(position) + offset);
  }
  for (MeshInstance& instance : scene.instances) {
    if (!isInWorldSpace[instance.geometry]) instance.objectToWorld[3] += glm::dvec4(offset, 0.0);
  }
  for (SceneCamera& camera : scene.cameras) camera.cameraToWorld[3] += glm::dvec4(offset, 0.0);
  for (PunctualLight& light : scene.lights) light.posW += offset;
}

void setFieldOfView(Scene& scene, double degrees) {
  for (SceneCamera& camera : scene.cameras) camera.yfov = glm::radians(degrees);
}

}  // namespace restlab::builtin
