// glTF materials: metallic-roughness with its supported extensions.
#pragma once

#include "core/scene/gltf_texture.h"

namespace restlab::gltf {

// Appends every material of the document to the scene, in the file's order.
void importMaterials(const Document& document, TextureImporter& textures, Scene& scene,
                     Report& report);

// The material that the specification gives to primitives without one: white, metallic 1,
// roughness 1. Appended at the first call; returns its index.
uint32_t defaultMaterial(Scene& scene, size_t documentMaterials);

// What rl::Material holds where a file says nothing: glTF's defaults, all texture slots empty.
rl::Material makeDefaultMaterial();

}  // namespace restlab::gltf
