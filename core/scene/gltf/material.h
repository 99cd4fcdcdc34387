// glTF materials: metallic-roughness with its supported extensions.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/gltf/texture.h"

namespace restlab::gltf {

// Reads `extras.priority` of each material of a valid document: -1e6 to 1e6, 0 if absent. Any other
// value gives 0 and a warning.
std::vector<int> readPriorities(const nlohmann::json& document, Report& report);

// Appends every material of the document to the scene, in the file's order; `priorities` has one
// entry per material.
void importMaterials(const Document& document, const std::vector<int>& priorities,
                     TextureImporter& textures, Scene& scene, Report& report);

// Returns the index of the material that the specification gives to primitives without one: white,
// metallic 1, roughness 1. The first call appends it.
uint32_t defaultMaterial(Scene& scene, size_t documentMaterials);

// Makes an rl::Material with glTF's defaults and empty texture slots.
rl::Material makeDefaultMaterial();

}  // namespace restlab::gltf
