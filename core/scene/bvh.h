// The project's own bounding volume hierarchy, for machines that Embree does not run on. Two
// levels: a tree over all triangles in world space and one over instances, joined in node 0; and a
// tree for every geometry that instances share. Built by Embree's builder (binned surface area
// heuristic).
#pragma once

#include <span>
#include <vector>

#include "core/dialect/types.h"

struct RTCDeviceTy;

namespace restlab {

struct Bvh {
  std::vector<rl::BvhNode> nodes;          // depth first, a parent before its children
  std::vector<rl::BvhTriangle> triangles;  // in the order of the leaves
  std::vector<uint32_t> roots;             // of a geometry, RL_INVALID where none is shared
  uint32_t depth = 0;                      // nodes from a root to the deepest leaf
  size_t bytes() const;
};

struct BvhInput {
  std::span<const glm::vec3> positions;
  std::span<const glm::uvec3> triangles;
  std::span<const rl::Geometry> geometries;
  std::span<const rl::Instance> instances;
};

// Throws Error (deviceUnavailable) where memory does not suffice, and std::runtime_error for a tree
// deeper than RL_BVH_MAX_DEPTH.
Bvh buildBvh(RTCDeviceTy* device, const BvhInput& input);

}  // namespace restlab
