// [[shape]] of a scene file.
#pragma once

#include <vector>

#include "core/base/config.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab {

// Adds a shape with its transform and material: one of `materials`, or one that the scene has.
// Throws Error (badUsage) at the place of what is wrong.
void addShape(const ConfigTable& table, const std::vector<Scattering>& materials, Scene& scene);

}  // namespace restlab
