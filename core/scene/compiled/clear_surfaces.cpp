#include "core/scene/compiled/clear_surfaces.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/dialect/features.h"
#include "core/scene/compiled/bodies.h"
#include "core/shading/bsdf.h"

namespace restlab {
namespace {

bool isClear(const SceneMaterial& material) {
  const rl::Material& m = material.data;
  constexpr uint32_t kOther =
      rl::RL_MATERIAL_UNLIT | rl::RL_MATERIAL_BLACK | rl::RL_MATERIAL_LAYERS;
  constexpr uint32_t kSlots[] = {rl::RL_TEX_BASE_COLOR, rl::RL_TEX_TRANSMISSION};
  const bool isTextured = std::any_of(std::begin(kSlots), std::end(kSlots), [&m](uint32_t slot) {
    return m.textures[slot] != rl::RL_INVALID;
  });
  return (m.flags & kOther) == 0 && m.closure == rl::RL_CLOSURE_GLTF && !isTextured &&
         std::abs(m.ior - 1.0f) < rl::RL_CLEAR_CONTRAST && m.transmission == 1.0f &&
         m.metallic == 0.0f && m.baseColor == glm::vec3(1.0f) && m.emission == glm::vec3(0.0f) &&
         m.sigmaAbsorption == glm::vec3(0.0f) && material.sigmaScattering == glm::vec3(0.0f);
}

}  // namespace

void leaveOutClearSurfaces(Scene& scene) {
  std::vector<char> leaves(scene.instances.size(), 0);
  bool hasAny = false;
  for (size_t i = 0; i < leaves.size(); ++i) {
    const MeshInstance& instance = scene.instances[i];
    leaves[i] = isClear(scene.materials[instance.material]) &&
                scene.geometries[instance.geometry].colors.empty();
    hasAny |= leaves[i] != 0;
  }
  if (!hasAny) return;
  const Bodies bodies = findBodies(scene);
  std::vector<MeshInstance> kept;
  std::string names;
  size_t count = 0;
  for (size_t i = 0; i < leaves.size(); ++i) {
    const bool mayDisplace = bodies.rank[i] != 0 && bodyMeetsAnother(bodies, i);
    if (leaves[i] == 0 || mayDisplace) {
      kept.push_back(scene.instances[i]);
      continue;
    }
    if (++count <= 3) names += (names.empty() ? "'" : ", '") + scene.instances[i].name + "'";
  }
  if (count == 0) return;
  scene.instances = std::move(kept);
  scene.warnings.push_back(scene.name + ": " + names + (count > 3 ? " and others" : "") +
                           (count == 1 ? " has" : " have") +
                           " an index of refraction of 1 and no colour: left out, as nothing can "
                           "be seen of it");
}

}  // namespace restlab
