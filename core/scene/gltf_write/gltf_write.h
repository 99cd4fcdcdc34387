// A scene as glTF 2.0, for this program and others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Writes FILE.gltf, and beside it FILE.bin with the meshes and FILE-N.png with the images.
// Materials that glTF does not have are in `extras.restlab`. Where the scene has surroundings,
// FILE.scene.toml begins with FILE.gltf and adds them, with FILE-sky.exr. Returns one line for each
// thing that is not in the files. Throws Error (badInput) if a file cannot be written, or a
// material cannot; (badUsage) if a file is one that the scene is made from, or if FILE.scene.toml
// is there with more than surroundings.
std::vector<std::string> writeGltf(const Scene& scene, const std::filesystem::path& file);

}  // namespace restlab
