#pragma once

#include <glm/glm.hpp>
#include <numbers>

namespace restlab::unit {

inline constexpr double kPi = std::numbers::pi;
inline const glm::vec3 kUp(0.0f, 0.0f, 1.0f);  // the normal, in local coordinates

}  // namespace restlab::unit
