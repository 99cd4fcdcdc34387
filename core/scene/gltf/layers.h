// The layers that extensions of glTF add to a material: clearcoat, sheen, anisotropy, iridescence,
// diffuse transmission and dispersion.
#pragma once

#include <string>

#include "core/scene/gltf/texture.h"

namespace restlab::gltf {

// Reads the extensions of a valid material into SceneMaterial::closure (RL_LAYER_*,
// core/shading/bsdf.h) and the flags of its data, which hold the rest of it already. A layer whose
// factor is 0 is left out. `place` is that of the material.
void importLayers(const tinygltf::Material& material, const std::string& place,
                  TextureImporter& textures, Report& report, SceneMaterial& result);

}  // namespace restlab::gltf
