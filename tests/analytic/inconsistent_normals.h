// Surfaces whose shading normals send light through their own faces, or face away from the viewer.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace restlab::analytic {

// Adds a map of round bumps and dents, 1 / 8 of the unit of texture coordinates apart, whose
// normals are tilted by up to asin(`sine`) in each direction; `sine` is at most 0.7. Returns the
// index of its use, for a material's slot RL_TEX_NORMAL.
uint32_t addBumps(Scene& scene, float sine);

// A closed solid in an environment of radiance 1, as in the built-in scene "sphere-furnace".
enum class Solid {
  flat,    // a polyhedron of many faces, nearly a sphere
  smooth,  // 80 faces, with the sphere's normals
  mapped,  // many faces, with the sphere's normals and bumps
};
Scene solidInFurnace(Solid solid, const rl::Material& material);

}  // namespace restlab::analytic
