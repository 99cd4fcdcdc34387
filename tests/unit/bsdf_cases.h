// The materials whose BSDFs are tested, made by the shipped surfaceLoad() from a hand-made
// triangle.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/dialect/order.h"

namespace restlab::unit {

// The BSDF of a material seen from its front or from its back.
rl::Bsdf bsdfOf(const rl::Material& material, bool front);

struct BsdfCase {
  std::string name;
  rl::Bsdf bsdf;
};

// Every combination of lobes that a material can have, over its range of roughness; delta lobes
// only where asked for.
std::vector<BsdfCase> continuousBsdfs();
std::vector<BsdfCase> deltaBsdfs();

// Angles of wo from the normal, in degrees; directionAt() has azimuth 0.7 rad.
inline constexpr double kAngles[] = {0.0, 60.0, 88.5};
glm::vec3 directionAt(double degrees);

}  // namespace restlab::unit
