// An analytic clear sky: smooth, bright around the sun and at the horizon, deep blue opposite the
// sun.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/scene.h"

namespace restlab::builtin {

struct Sky {
  glm::dvec3 towardsSun =
      glm::normalize(glm::dvec3(-0.45, 0.80, -0.40));  // unit, above the horizon
  glm::vec3 ground{0.15f, 0.13f, 0.11f};               // radiance below the horizon
};

// Radiance that a ray of unit direction `dir` sees, before normalisation.
glm::dvec3 skyRadiance(const Sky& sky, const glm::dvec3& dir);

// The sky as a map, scaled to a mean cosine-weighted luminance of 1 above a level plane (irradiance
// pi).
EnvironmentMap skyMap(const Sky& sky, uint32_t width, uint32_t height);

}  // namespace restlab::builtin
