// glTF materials: metallic-roughness with its supported extensions.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/gltf_texture.h"

namespace restlab::gltf {

// Reads `extras.priority` of each material of a valid document: -1e6 to 1e6, 0 where there is none.
// Anything else is a warning, and 0.
std::vector<int> readPriorities(const nlohmann::json& document, Report& report);

// Appends every material of the document to the scene, in the file's order; `priorities` has one
// for each.
void importMaterials(const Document& document, const std::vector<int>& priorities,
                     TextureImporter& textures, Scene& scene, Report& report);

// The material that the specification gives to primitives without one: white, metallic 1,
// roughness 1. Appended at the first call; returns its index.
uint32_t defaultMaterial(Scene& scene, size_t documentMaterials);

// What rl::Material holds where a file says nothing: glTF's defaults, all texture slots empty.
rl::Material makeDefaultMaterial();

}  // namespace restlab::gltf
