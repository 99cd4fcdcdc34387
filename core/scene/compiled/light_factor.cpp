#include "core/scene/compiled/light_factor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace restlab {

namespace {

constexpr const char* kEnvironment = "environment";
constexpr const char* kAmbient = "ambient";

bool hasAmbient(const Scene& scene) { return scene.ambient != glm::vec3(0.0f); }

bool emits(const SceneMaterial& material) {
  const glm::vec3& e = material.data.emission;
  return (material.data.flags & rl::RL_MATERIAL_UNLIT) == 0 && std::max({e.x, e.y, e.z}) > 0.0f;
}

// Sets the light factor of emitting materials. A material that other meshes share is copied, so
// that those keep their factor. The copy goes last, as materials are known by their index.
void setEmission(Scene& scene, const std::string& name, float factor) {
  const size_t count = scene.materials.size();
  for (uint32_t m = 0; m < count; ++m) {
    if (!emits(scene.materials[m])) continue;
    const bool isWhole = name == kAllLights || scene.materials[m].name == name;
    std::vector<MeshInstance*> wanted;
    bool isShared = false;
    for (MeshInstance& instance : scene.instances) {
      if (instance.material != m) continue;
      if (isWhole || instance.name == name) {
        wanted.push_back(&instance);
      } else {
        isShared = true;
      }
    }
    if (wanted.empty()) continue;
    uint32_t own = m;
    if (isShared) {
      own = static_cast<uint32_t>(scene.materials.size());
      scene.materials.push_back(SceneMaterial(scene.materials[m]));
      for (MeshInstance* instance : wanted) instance->material = own;
    }
    scene.materials[own].lightFactor = factor;
  }
}

}  // namespace

std::vector<std::string> lightNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const MeshInstance& instance : scene.instances) {
    const SceneMaterial& material = scene.materials[instance.material];
    if (!emits(material)) continue;
    names.push_back(instance.name);
    names.push_back(material.name);
  }
  for (const PunctualLight& light : scene.lights) names.push_back(light.name);
  if (scene.environment) names.push_back(kEnvironment);
  if (hasAmbient(scene)) names.push_back(kAmbient);
  std::erase(names, "");
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void requireLight(const Scene& scene, const std::string& name) {
  std::vector<std::string> names = lightNames(scene);
  if (name == kAllLights || std::binary_search(names.begin(), names.end(), name)) return;
  names.push_back(kAllLights);
  const std::string suggestion = didYouMean(name, names);
  constexpr size_t kShown = 12;
  const std::string more = names.size() > kShown ? ", ..." : "";
  names.resize(std::min(names.size(), kShown));
  failUsage(fmt::format("light '{}': scene {} has {}{}{}", name, scene.name, fmt::join(names, ", "),
                        more, suggestion));
}

Scene withLightFactor(Scene scene, const std::string& name, double factor) {
  requireLight(scene, name);
  const auto value = static_cast<float>(factor);
  if (!(factor >= 0.0 && std::isfinite(value))) {
    failUsage(fmt::format("light '{}': its factor is {}, but must be 0 or more", name, factor));
  }
  const bool isAll = name == kAllLights;
  setEmission(scene, name, value);
  for (PunctualLight& light : scene.lights) {
    if (isAll || light.name == name) light.lightFactor = value;
  }
  if (scene.environment && (isAll || name == kEnvironment)) scene.environment->lightFactor = value;
  if (hasAmbient(scene) && (isAll || name == kAmbient)) scene.ambientFactor = value;
  return scene;
}

std::vector<float> lightFactors(const Scene& scene) {
  std::vector<float> factors;
  for (const MeshInstance& instance : scene.instances)
    factors.push_back(scene.materials[instance.material].lightFactor);
  for (const PunctualLight& light : scene.lights) factors.push_back(light.lightFactor);
  if (scene.environment) factors.push_back(scene.environment->lightFactor);
  if (hasAmbient(scene)) factors.push_back(scene.ambientFactor);
  const bool isPlain =
      std::all_of(factors.begin(), factors.end(), [](float factor) { return factor == 1.0f; });
  if (isPlain) factors.clear();
  return factors;
}

}  // namespace restlab
