// [[shape]] of a scene file.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/config.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab {

// Adds a shape, or the mesh of a file below `folder`, with its transform and material: one of
// `materials`, or one that the scene has. Its 'instances' share the geometry.
// Throws Error (badUsage, badInput) at the place of what is wrong.
void addShape(const ConfigTable& table, const std::filesystem::path& folder,
              const std::vector<Scattering>& materials, Scene& scene);

}  // namespace restlab
