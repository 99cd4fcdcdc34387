#include "tests/unit/layered.h"

#include <bit>
#include <cmath>

#include "core/shading/bsdf.h"

namespace restlab::unit {

SceneMaterial layered(const rl::Material& base, const Layers& l) {
  SceneMaterial material{"material", base};
  material.closure.resize(rl::RL_LAYER_COUNT);
  const auto set = [&](uint32_t layer, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) material.closure[layer].words[i] = std::bit_cast<uint32_t>(v[i]);
  };
  uint32_t& flags = material.data.flags;
  if (l.coat > 0.0f) flags |= rl::RL_MATERIAL_CLEARCOAT;
  if (l.sheen != glm::vec3(0.0f)) flags |= rl::RL_MATERIAL_SHEEN;
  if (l.anisotropy > 0.0f) flags |= rl::RL_MATERIAL_ANISOTROPY;
  if (l.film > 0.0f) flags |= rl::RL_MATERIAL_IRIDESCENCE;
  if (l.passing > 0.0f) flags |= rl::RL_MATERIAL_DIFFUSE_TRANSMISSION;
  if (l.dispersion > 0.0f) flags |= rl::RL_MATERIAL_DISPERSION;
  set(rl::RL_LAYER_CLEARCOAT, glm::vec3(l.coat));
  set(rl::RL_LAYER_CLEARCOAT_ROUGHNESS, glm::vec3(l.coatRoughness));
  set(rl::RL_LAYER_CLEARCOAT_NORMAL, glm::vec3(1.0f));
  set(rl::RL_LAYER_SHEEN_COLOR, l.sheen);
  set(rl::RL_LAYER_SHEEN_ROUGHNESS, glm::vec3(l.sheenRoughness));
  set(rl::RL_LAYER_ANISOTROPY, {l.anisotropy, std::cos(l.rotation), std::sin(l.rotation)});
  set(rl::RL_LAYER_IRIDESCENCE, glm::vec3(l.film));
  set(rl::RL_LAYER_FILM, {0.0f, l.thickness, l.filmIor});
  set(rl::RL_LAYER_DIFFUSE_TRANSMISSION, glm::vec3(l.passing));
  set(rl::RL_LAYER_DIFFUSE_TRANSMISSION_COLOR, l.passingColor);
  set(rl::RL_LAYER_DISPERSION, glm::vec3(l.dispersion));
  return material;
}

}  // namespace restlab::unit
