// A hierarchy over the lamps of a scene, by which a receiver chooses among them: Conty Estevez and
// Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
#pragma once

#include <vector>

#include "core/dialect/types.h"

namespace restlab {

// Beyond so many lamps there is no hierarchy: it takes a second to build for these.
constexpr size_t kMostLampsOfTree = size_t{1} << 17;

struct LightTree {
  // RL_LIGHT_NODE_UVEC4S each, the root first. Empty: no lamp shines, or there are too many.
  std::vector<glm::uvec4> nodes;
  size_t lamps = 0;    // triangles, points and spots, also those that are off
  float share = 0.0f;  // probability that the alias table gives a lamp of the hierarchy
};

// Builds the hierarchy over triangles, points and spots of positive probability in the alias table,
// and sets Light::trail of each: its part of each node from the root on, two bits a node, the
// lowest first. Deterministic. No lamp is below more than RL_LIGHT_TREE_DEPTH nodes.
LightTree buildLightTree(std::vector<rl::Light>& lights);

}  // namespace restlab
