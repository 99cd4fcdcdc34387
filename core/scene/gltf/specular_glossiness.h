// KHR_materials_pbrSpecularGlossiness, as a material of metallic-roughness without metal.
#pragma once

#include <string>

#include "core/scene/gltf/texture.h"

namespace restlab::gltf {

constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

// Warns of extensions that have no meaning beside this one, and where it has none itself.
void checkSpecularGlossiness(const tinygltf::Material& material, const std::string& place,
                             Report& report);

// Sets base colour, alpha, reflectance and roughness.
void importSpecularGlossiness(const tinygltf::Value& extension, const std::string& place,
                              TextureImporter& textures, rl::Material& material);

}  // namespace restlab::gltf
