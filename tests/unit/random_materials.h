// Random materials and textures whose factors and texels are often exactly 0 or 1.
#pragma once

#include <iterator>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/scene.h"
#include "tests/unit/layered.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {

inline float randomFactor(Inputs& inputs) {
  const uint32_t kind = inputs.below(3);
  return kind == 0 ? 0.0f : kind == 1 ? 1.0f : inputs.uniform();
}

// Adds a 2 x 1 image whose channels are 0 or 255 throughout, or differ between its texels.
inline uint32_t addRandomTexture(Scene& scene, Inputs& inputs) {
  TextureImage image{"image", 2, 1, {0u, 0u}};
  for (uint32_t channel = 0; channel < 4; ++channel) {
    const uint32_t kind = inputs.below(3);
    for (uint32_t& texel : image.texels) {
      const uint32_t value = kind == 0 ? 0u : kind == 1 ? 255u : inputs.below(256);
      texel |= value << (8u * channel);
    }
  }
  scene.images.push_back(image);
  TextureUse use;
  use.image = uint32_t(scene.images.size() - 1);
  use.srgb = inputs.below(2) == 0;
  scene.textureUses.push_back(use);
  return uint32_t(scene.textureUses.size() - 1);
}

inline rl::Material randomMaterial(Scene& scene, Inputs& inputs) {
  const auto colour = [&inputs] {
    const float r = randomFactor(inputs), g = randomFactor(inputs);
    return glm::vec3(r, g, randomFactor(inputs));
  };
  rl::Material m = builtin::lambert(colour());
  m.metallic = randomFactor(inputs);
  m.roughness = randomFactor(inputs);
  m.ior = inputs.below(4) == 0 ? 1.0f : inputs.uniform(1.1f, 2.0f);
  m.transmission = inputs.below(2) == 0 ? 0.0f : randomFactor(inputs);
  m.specular = randomFactor(inputs);
  m.specularColor = colour();
  if (inputs.below(2) == 0) m.emission = colour();
  if (inputs.below(2) == 0) m.sigmaAbsorption = {randomFactor(inputs), 0.0f, randomFactor(inputs)};
  constexpr uint32_t kFlags[] = {0u, 0u, rl::RL_MATERIAL_THIN, rl::RL_MATERIAL_BLACK,
                                 rl::RL_MATERIAL_UNLIT};
  m.flags |= kFlags[inputs.below(std::size(kFlags))];
  for (uint32_t slot = 0; slot < rl::RL_TEX_COUNT; ++slot) {
    if (slot != rl::RL_TEX_NORMAL && inputs.below(3) == 0)
      m.textures[slot] = addRandomTexture(scene, inputs);
  }
  return m;
}

// Adds layers of glTF's extensions, with or without textures.
inline void addRandomLayers(Scene& scene, SceneMaterial& material, Inputs& inputs) {
  Layers l;
  l.coat = randomFactor(inputs);
  l.coatRoughness = randomFactor(inputs);
  if (inputs.below(2) == 0) l.sheen = {randomFactor(inputs), 0.5f, 0.2f};
  l.sheenRoughness = randomFactor(inputs);
  l.anisotropy = randomFactor(inputs);
  l.rotation = inputs.uniform();
  l.film = randomFactor(inputs);
  l.thickness = 800.0f * inputs.uniform();
  l.passing = randomFactor(inputs);
  l.dispersion = randomFactor(inputs);
  material = layered(material.data, l);
  for (ClosureValue& value : material.closure) {
    if (inputs.below(5) != 0) continue;
    value.texture = addRandomTexture(scene, inputs);
    value.channel = inputs.below(4);
  }
}

// Squares of 1 m in a row along +x, 3 m apart, facing +z, each with its own material.
inline Scene randomSquares(Inputs& inputs, uint32_t count, bool hasLayers = false) {
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    MeshGeometry mesh = builtin::quad("square", {3.0 * i, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.geometries.push_back(mesh);
    scene.materials.push_back({"material", randomMaterial(scene, inputs)});
    if (hasLayers && inputs.below(2) == 0) addRandomLayers(scene, scene.materials.back(), inputs);
    scene.instances.push_back({"square", i, i, glm::dmat4(1.0)});
  }
  return scene;
}

}  // namespace restlab::unit
