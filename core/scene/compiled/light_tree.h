// A hierarchy over the lamps of a scene, by which a receiver chooses among them: Conty Estevez and
// Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".
#pragma once

#include <vector>

#include "core/dialect/types.h"

namespace restlab {

// The hierarchy parts lamps down to about so many clusters, and power chooses within one: a draw
// takes as long with 10^6 lamps as with these (docs/decisions/hierarchy-of-lamps.md).
constexpr size_t kClustersOfLamps = 1024;

struct LightTree {
  // RL_LIGHT_NODE_UVEC4S a node, the root first, then clusters. Empty: no lamp shines.
  std::vector<glm::uvec4> nodes;
  std::vector<uint32_t> trails;  // SceneData::lightTrails
};

// Builds the hierarchy over triangles, points and spots of positive probability in the alias table.
// A cluster has at most lamps / `clusters` of them, or one. Deterministic. No lamp is below more
// than RL_LIGHT_TREE_DEPTH nodes.
LightTree buildLightTree(const std::vector<rl::Light>& lights, size_t clusters = kClustersOfLamps);

}  // namespace restlab
