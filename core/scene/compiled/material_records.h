// Materials and textures as kernels read them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/dialect/types.h"
#include "core/scene/scene.h"

namespace restlab {

struct MaterialRecords {
  std::vector<rl::Material> materials;
  std::vector<glm::uvec4> closureParameters;  // SceneData::closureParameters
  std::vector<rl::Texture> textures;
  std::vector<uint32_t> texels;
  std::vector<float> srgb;  // SceneData::srgbToLinear
};

// Throws Error (badInput) if the textures have more texels than 32 bits can count.
MaterialRecords materialRecords(const Scene& scene);

}  // namespace restlab
