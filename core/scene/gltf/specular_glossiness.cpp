#include "core/scene/gltf/specular_glossiness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace restlab::gltf {
namespace {

template <size_t N>
std::array<double, N> numbersOf(const tinygltf::Value& object, const char* name) {
  std::array<double, N> numbers;
  numbers.fill(1.0);  // the default of all factors
  if (!object.Has(name)) return numbers;
  for (size_t i = 0; i < N; ++i)
    numbers[i] = object.Get(name).Get(static_cast<int>(i)).GetNumberAsDouble();
  return numbers;
}

TextureReference textureOf(const tinygltf::Value& object, const char* name) {
  TextureReference reference;
  if (!object.Has(name)) return reference;
  const tinygltf::Value& info = object.Get(name);
  reference.index = info.Get("index").GetNumberAsInt();
  if (info.Has("texCoord")) reference.texCoord = info.Get("texCoord").GetNumberAsInt();
  if (info.Has("extensions"))
    reference.ownedExtensions = info.Get("extensions").Get<tinygltf::Value::Object>();
  return reference;
}

}  // namespace

void checkSpecularGlossiness(const tinygltf::Material& material, const std::string& place,
                             Report& report) {
  const auto has = [&](const char* name) { return material.extensions.count(name) != 0; };
  if (!has(kSpecularGlossiness)) return;
  const auto warn = [&](const char* unread, const char* beside) {
    report.warn("beside another material", fmt::format("{}.extensions.{}", place, unread),
                fmt::format("is not read beside {}", beside));
  };
  if (has("KHR_materials_unlit")) {
    warn(kSpecularGlossiness, "KHR_materials_unlit");
    return;
  }
  for (const char* other :
       {"KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
        "KHR_materials_dispersion", "KHR_materials_ior", "KHR_materials_iridescence",
        "KHR_materials_sheen", "KHR_materials_specular", "KHR_materials_transmission",
        "KHR_materials_volume"}) {
    if (has(other)) warn(other, kSpecularGlossiness);
  }
}

// The reflectance at normal incidence is the specular colour itself: an index of 0 stands for the
// factor 1. The specification takes max(specular) from the diffuse colour; the lobes do so, angle
// by angle (bsdfBaseShare() in core/shading/bsdf.glsl), so that the diffuse colour is the base
// colour.
void importSpecularGlossiness(const tinygltf::Value& extension, const std::string& place,
                              TextureImporter& textures, rl::Material& material) {
  const auto diffuse = numbersOf<4>(extension, "diffuseFactor");
  const auto specular = numbersOf<3>(extension, "specularFactor");
  const double glossiness = extension.Has("glossinessFactor")
                                ? extension.Get("glossinessFactor").GetNumberAsDouble()
                                : 1.0;
  material.baseColor = glm::dvec3(diffuse[0], diffuse[1], diffuse[2]);
  material.alpha = static_cast<float>(diffuse[3]);
  material.metallic = 0.0f;
  material.ior = 0.0f;
  material.specular = 1.0f;
  material.specularColor = glm::dvec3(specular[0], specular[1], specular[2]);
  material.roughness = static_cast<float>(1.0 - glossiness);
  TextureReference color = textureOf(extension, "diffuseTexture");
  if (color.index >= 0) {
    color.extensions = &color.ownedExtensions;
    material.textures[rl::RL_TEX_BASE_COLOR] = textures.add(color, true, place + ".diffuseTexture");
  }
  TextureReference both = textureOf(extension, "specularGlossinessTexture");
  if (both.index < 0) return;
  both.extensions = &both.ownedExtensions;
  const std::string texturePlace = place + ".specularGlossinessTexture";
  material.textures[rl::RL_TEX_SPECULAR_COLOR] = textures.add(both, true, texturePlace);
  if (glossiness == 0.0) return;  // rough everywhere
  material.textures[rl::RL_TEX_METALLIC_ROUGHNESS] =
      textures.addRoughness(both, glossiness, texturePlace);
  material.roughness = 1.0f;
}

uint32_t TextureImporter::addRoughness(const TextureReference& reference, double glossiness,
                                       const std::string& place) {
  const uint32_t use = add(reference, false, place);
  const uint32_t source = scene_.textureUses[use].image;
  const auto [known, isNew] = roughnessImage_.try_emplace({source, glossiness}, rl::RL_INVALID);
  if (isNew) {
    const TextureImage& image = scene_.images[source];
    const size_t count = image.texels.size();
    report_.takeMemory(place, "its roughness", count * sizeof(uint32_t));
    TextureImage rough{image.name + " (roughness)", image.width, image.height, {}};
    rough.texels.reserve(count);
    for (const uint32_t texel : image.texels) {
      const double roughness = 1.0 - glossiness * (texel >> 24) / 255.0;
      const auto green = static_cast<uint32_t>(std::lround(255.0 * roughness));
      rough.texels.push_back(0xffff00ffu | green << 8);
    }
    known->second = static_cast<uint32_t>(scene_.images.size());
    scene_.images.push_back(std::move(rough));
  }
  scene_.textureUses[use].image = known->second;
  return use;
}

}  // namespace restlab::gltf
