// The project's own bounding volume hierarchy, for machines that Embree does not run on. Two
// levels: a tree over all triangles in world space and one over instances, joined in node 0; and a
// tree for every geometry that instances share. Built by Embree's builder (binned surface area
// heuristic) with four children per node, whose bounds are bytes on a grid of the node (Ylitie,
// Karras and Laine 2017, section 3): memory accesses dominate a kernel's time.
#pragma once

#include <span>
#include <vector>

#include "core/dialect/types.h"

struct RTCDeviceTy;
struct RTCBounds;

namespace restlab {

// Bounds of child k along an axis: origin + byte k of low or high, times 2^(exponent - 127).
struct BvhNode {
  glm::vec3 origin{0.0f};
  uint32_t exponents = 0;  // one byte per axis
  uint32_t low[3] = {};    // per axis; byte k belongs to child k
  uint32_t high[3] = {};
  uint32_t children[4] = {rl::RL_INVALID, rl::RL_INVALID, rl::RL_INVALID, rl::RL_INVALID};
  uint32_t unused[2] = {};
};
struct BvhTriangle {
  glm::vec3 p0{0.0f}, p1{0.0f}, p2{0.0f};
  uint32_t isTransparent = 0;  // perhaps only in part: rays check the material
  uint32_t instance = 0;       // RL_INVALID in a shared mesh
  uint32_t primitive = 0;
  uint32_t unused[4] = {};
};

// A node or a triangle, of equal size: a ray reads the next record of either kind in one step.
struct BvhRecord {
  uint32_t words[4 * rl::RL_BVH_RECORD_UVEC4S] = {};
};
static_assert(sizeof(BvhNode) == sizeof(BvhRecord) && sizeof(BvhTriangle) == sizeof(BvhRecord));

struct Bvh {
  std::vector<BvhRecord> records;  // depth first, parents before children; 0 is the world's root
  std::vector<uint32_t> roots;     // root record by geometry; RL_INVALID if not shared
  size_t nodeCount = 0, triangleCount = 0;
  uint32_t depth = 0;  // nodes from a root to the deepest leaf
  size_t bytes() const;
};

struct BvhInput {
  std::span<const glm::vec3> positions;
  std::span<const glm::uvec3> triangles;
  std::span<const rl::Geometry> geometries;
  std::span<const rl::Instance> instances;
  std::span<const RTCBounds> shapeBoxes;  // core/scene/compiled/shape_records.h
};

// Throws Error (deviceUnavailable) if memory does not suffice, and std::runtime_error if the tree
// is deeper than RL_BVH_MAX_DEPTH.
Bvh buildBvh(RTCDeviceTy* device, const BvhInput& input);

}  // namespace restlab
