#include "core/scene/compiled/black_textures.h"

#include "core/scene/textures/texture_range.h"

namespace restlab {
namespace {

void foldColor(glm::vec3& factor, const TexelRange& range) {
  for (int c = 0; c < 3; ++c) {
    if (range.high[size_t(c)] == 0.0f) factor[c] = 0.0f;
  }
}

void foldNumber(float& factor, float highest) {
  if (highest == 0.0f) factor = 0.0f;
}

}  // namespace

void foldBlackTextures(Scene& scene) {
  TextureRanges ranges(scene);
  for (SceneMaterial& material : scene.materials) {
    rl::Material& m = material.data;
    const auto drop = [&m](uint32_t slot, bool isZero) {
      if (isZero) m.textures[slot] = rl::RL_INVALID;
    };
    foldColor(m.emission, ranges.ofSlot(m, rl::RL_TEX_EMISSIVE));
    drop(rl::RL_TEX_EMISSIVE, m.emission == glm::vec3(0.0f));
    foldColor(m.specularColor, ranges.ofSlot(m, rl::RL_TEX_SPECULAR_COLOR));
    drop(rl::RL_TEX_SPECULAR_COLOR, m.specularColor == glm::vec3(0.0f));
    foldNumber(m.specular, ranges.ofSlot(m, rl::RL_TEX_SPECULAR).high[3]);
    drop(rl::RL_TEX_SPECULAR, m.specular == 0.0f);
    foldNumber(m.transmission, ranges.ofSlot(m, rl::RL_TEX_TRANSMISSION).high[0]);
    drop(rl::RL_TEX_TRANSMISSION, m.transmission == 0.0f);
    const TexelRange& metalRough = ranges.ofSlot(m, rl::RL_TEX_METALLIC_ROUGHNESS);
    foldNumber(m.roughness, metalRough.high[1]);
    foldNumber(m.metallic, metalRough.high[2]);
    drop(rl::RL_TEX_METALLIC_ROUGHNESS, m.roughness == 0.0f && m.metallic == 0.0f);
  }
}

}  // namespace restlab
