// Solids made of others by their signed distances, as "smooth_union(0.2, sphere(0.5), box(1, 1,
// 1))".
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/scene/field/program.h"
#include "core/scene/field/solid_tree.h"

namespace restlab {

// Without a box it follows from the solids. Throws Error (badInput) without a file: the place in
// the text, what is wrong.
FieldProgram readSolid(const std::string& text,
                       const std::optional<std::array<glm::vec3, 2>>& box = std::nullopt,
                       const GridFiles& files = {});

}  // namespace restlab
