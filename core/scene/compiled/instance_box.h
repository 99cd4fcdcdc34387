// Boxes of instances in world space.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "core/dialect/types.h"

namespace restlab {

// Bounds a box (low, high) under the transform of an instance, moved out by the rounding error of a
// ray's transform: |M| |p| + |T| bounds every intermediate.
std::array<glm::vec3, 2> boxOfInstance(const rl::Instance& inst,
                                       const std::array<glm::vec3, 2>& local);

}  // namespace restlab
