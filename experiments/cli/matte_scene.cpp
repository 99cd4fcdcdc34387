#include "experiments/cli/matte_scene.h"

#include "core/dialect/features.h"

namespace restlab {

namespace {

// The mean of a channel of a material's texture, 0 to 1; 1 where it has none.
float meanOfTexture(const Scene& scene, uint32_t use, uint32_t channel) {
  if (use == rl::RL_INVALID) return 1.0f;
  const TextureImage& image = scene.images[scene.textureUses[use].image];
  double sum = 0.0;
  for (const uint32_t texel : image.texels) sum += (texel >> (8 * channel)) & 255u;
  return image.texels.empty() ? 1.0f : float(sum / (255.0 * double(image.texels.size())));
}

bool isMirrorLike(uint32_t closure) {
  return closure == rl::RL_CLOSURE_MIRROR || closure == rl::RL_CLOSURE_POWER_LOBE ||
         closure == rl::RL_CLOSURE_CONDUCTOR;
}

}  // namespace

Scene matteScene(Scene scene) {
  constexpr uint32_t kBlue = 2, kRed = 0;
  for (SceneMaterial& material : scene.materials) {
    rl::Material& m = material.data;
    const bool scattersInside = material.sigmaScattering != glm::vec3(0.0f);
    if (scattersInside || (m.flags & rl::RL_MATERIAL_UNLIT) != 0) continue;
    float share = 0.0f;
    if (m.closure == rl::RL_CLOSURE_GLTF) {
      const uint32_t* textures = m.textures;
      const float metallic =
          m.metallic * meanOfTexture(scene, textures[rl::RL_TEX_METALLIC_ROUGHNESS], kBlue);
      const float transmission =
          m.transmission * meanOfTexture(scene, textures[rl::RL_TEX_TRANSMISSION], kRed);
      share = (1.0f - metallic) * (1.0f - transmission);
    } else if (!isMirrorLike(m.closure)) {
      continue;
    }
    m.closure = rl::RL_CLOSURE_GLTF;
    material.closure.clear();
    m.baseColor *= share;
    m.metallic = m.transmission = m.specular = 0.0f;
    m.sigmaAbsorption = glm::vec3(0.0f);
    m.flags &= ~(rl::RL_MATERIAL_LAYERS | rl::RL_MATERIAL_ANISOTROPIC | rl::RL_MATERIAL_THIN);
    for (const uint32_t slot : {rl::RL_TEX_METALLIC_ROUGHNESS, rl::RL_TEX_TRANSMISSION,
                                rl::RL_TEX_SPECULAR, rl::RL_TEX_SPECULAR_COLOR})
      m.textures[slot] = rl::RL_INVALID;
  }
  return scene;
}

}  // namespace restlab
