#include "core/scene/bvh.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "core/dialect/order.h"
#include "core/error.h"

namespace restlab {

namespace {

constexpr uint32_t kLeafSize = 4;
// A place that no ray reaches: the bounds of a child that is not there.
constexpr float kNowhere = 3.0e38f;

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};
  void add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

// A node of the builder's tree, in its own memory.
struct BuildNode {
  bool isLeaf = false;
  BuildNode* children[2] = {nullptr, nullptr};
  Box boxes[2];
  uint32_t count = 0;
  uint32_t items[kLeafSize] = {};
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned int, void*) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode))) BuildNode();
}

void setChildren(void* node, void** children, unsigned int count, void*) {
  for (unsigned int i = 0; i < count; ++i) {
    static_cast<BuildNode*>(node)->children[i] = static_cast<BuildNode*>(children[i]);
  }
}

void setBounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
  for (unsigned int i = 0; i < count; ++i) {
    Box& box = static_cast<BuildNode*>(node)->boxes[i];
    box.low = {bounds[i]->lower_x, bounds[i]->lower_y, bounds[i]->lower_z};
    box.high = {bounds[i]->upper_x, bounds[i]->upper_y, bounds[i]->upper_z};
  }
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 size_t count, void*) {
  auto* leaf = static_cast<BuildNode*>(createNode(allocator, 0, nullptr));
  leaf->isLeaf = true;
  leaf->count = static_cast<uint32_t>(count);
  for (size_t i = 0; i < count; ++i) leaf->items[i] = primitives[i].primID;
  return leaf;
}

struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

class Builder {
 public:
  Builder(RTCDevice device, const BvhInput& input) : device_(device), in_(input) {}

  Bvh build() {
    bvh_.roots.assign(in_.geometries.size(), rl::RL_INVALID);
    bvh_.nodes.push_back(nodeOfNothing());
    std::vector<Triangle> world;
    std::vector<uint32_t> placed;  // instances
    for (uint32_t i = 0; i < in_.instances.size(); ++i) {
      const rl::Instance& inst = in_.instances[i];
      if (in_.geometries[inst.geometry].triangleCount == 0) continue;
      if ((inst.flags & rl::RL_INSTANCE_IDENTITY) == 0) {
        placed.push_back(i);
        continue;
      }
      const bool isTransparent = (inst.flags & rl::RL_INSTANCE_ALPHA) != 0;
      addTriangles(world, inst.geometry, i, isTransparent);
    }
    setChild(0, 0, treeOfTriangles(world));
    for (const uint32_t i : placed) buildGeometry(in_.instances[i].geometry);
    setChild(0, 1, treeOfInstances(placed));
    return std::move(bvh_);
  }

 private:
  using Triangle = rl::BvhTriangle;
  struct Child {
    uint32_t number = 0;
    Box box;
    bool exists = false;
  };

  static rl::BvhNode nodeOfNothing() {
    rl::BvhNode node{};
    node.low0 = node.high0 = node.low1 = node.high1 = glm::vec3(kNowhere);
    return node;
  }

  void setChild(uint32_t node, int side, const Child& child) {
    if (!child.exists) return;
    rl::BvhNode& n = bvh_.nodes[node];
    (side == 0 ? n.child0 : n.child1) = child.number;
    (side == 0 ? n.low0 : n.low1) = child.box.low;
    (side == 0 ? n.high0 : n.high1) = child.box.high;
  }

  void addTriangles(std::vector<Triangle>& out, uint32_t geometry, uint32_t instance,
                    bool isTransparent) const {
    const rl::Geometry& g = in_.geometries[geometry];
    for (uint32_t t = 0; t < g.triangleCount; ++t) {
      const glm::uvec3 corners = in_.triangles[g.firstTriangle + t];
      Triangle triangle{};
      triangle.p0 = in_.positions[g.firstVertex + corners.x];
      triangle.p1 = in_.positions[g.firstVertex + corners.y];
      triangle.p2 = in_.positions[g.firstVertex + corners.z];
      triangle.instance = instance;
      triangle.primitive = t;
      triangle.isTransparent = isTransparent ? 1u : 0u;
      out.push_back(triangle);
    }
  }

  static Box boxOf(const Triangle& t) {
    Box box;
    box.add(t.p0);
    box.add(t.p1);
    box.add(t.p2);
    return box;
  }

  // The corners of the mesh's box, transformed, and the rounding error of a ray's transform.
  Box boxOf(const rl::Instance& inst) const {
    const Box mesh = geometryBoxes_.at(inst.geometry);
    Box box;
    const glm::vec4 rows[3] = {inst.objectToWorldRow0, inst.objectToWorldRow1,
                               inst.objectToWorldRow2};
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec4 p((corner & 1) != 0 ? mesh.high.x : mesh.low.x,
                        (corner & 2) != 0 ? mesh.high.y : mesh.low.y,
                        (corner & 4) != 0 ? mesh.high.z : mesh.low.z, 1.0f);
      glm::vec3 at, magnitude;
      for (int c = 0; c < 3; ++c) {
        at[c] = glm::dot(rows[c], p);
        magnitude[c] = glm::dot(glm::abs(rows[c]), glm::abs(p));
      }
      const float error = rl::RL_HIT_ERROR * std::max({magnitude.x, magnitude.y, magnitude.z});
      box.add(at - error);
      box.add(at + error);
    }
    return box;
  }

  void buildGeometry(uint32_t geometry) {
    if (bvh_.roots[geometry] != rl::RL_INVALID) return;
    std::vector<Triangle> triangles;
    addTriangles(triangles, geometry, rl::RL_INVALID, false);
    Box box;
    for (const Triangle& t : triangles) {
      box.add(boxOf(t).low);
      box.add(boxOf(t).high);
    }
    geometryBoxes_.resize(in_.geometries.size());
    geometryBoxes_[geometry] = box;
    const Child tree = treeOfTriangles(triangles);
    if ((tree.number & rl::RL_BVH_KIND) == 0u) {
      bvh_.roots[geometry] = tree.number;
      return;
    }
    bvh_.roots[geometry] = static_cast<uint32_t>(bvh_.nodes.size());
    bvh_.nodes.push_back(nodeOfNothing());
    setChild(bvh_.roots[geometry], 0, tree);
  }

  Child treeOfTriangles(const std::vector<Triangle>& triangles) {
    std::vector<Box> boxes;
    for (const Triangle& t : triangles) boxes.push_back(boxOf(t));
    return tree(boxes, kLeafSize, [&](const BuildNode& leaf) {
      const auto first = static_cast<uint32_t>(bvh_.triangles.size());
      if (first + leaf.count > rl::RL_BVH_LEAF_FIRST) {
        throw Error(ExitCode::deviceUnavailable,
                    fmt::format("the scene has more than {} triangles, which the project's own "
                                "hierarchy cannot number",
                                rl::RL_BVH_LEAF_FIRST));
      }
      for (uint32_t i = 0; i < leaf.count; ++i) bvh_.triangles.push_back(triangles[leaf.items[i]]);
      return rl::RL_BVH_LEAF | leaf.count << rl::RL_BVH_LEAF_COUNT_SHIFT | first;
    });
  }

  Child treeOfInstances(const std::vector<uint32_t>& instances) {
    std::vector<Box> boxes;
    for (const uint32_t i : instances) boxes.push_back(boxOf(in_.instances[i]));
    return tree(boxes, 1, [&](const BuildNode& leaf) {
      return rl::RL_BVH_INSTANCE | instances[leaf.items[0]];
    });
  }

  // `number` gives the number of a leaf as a child.
  template <class Number>
  Child tree(const std::vector<Box>& boxes, uint32_t leafSize, const Number& number) {
    Child child;
    if (boxes.empty()) return child;
    std::vector<RTCBuildPrimitive> primitives(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
      primitives[i] = {boxes[i].low.x,  boxes[i].low.y,  boxes[i].low.z,  0,
                       boxes[i].high.x, boxes[i].high.y, boxes[i].high.z, uint32_t(i)};
      child.box.add(boxes[i].low);
      child.box.add(boxes[i].high);
    }
    const std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> memory(rtcNewBVH(device_));
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = rl::RL_BVH_MAX_DEPTH;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = leafSize;
    arguments.bvh = memory.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (root == nullptr) {
      throw Error(ExitCode::deviceUnavailable,
                  fmt::format("building the hierarchy of {} boxes failed (Embree error {})",
                              boxes.size(), static_cast<int>(rtcGetDeviceError(device_))));
    }
    child.number = place(*root, 1, number);
    child.exists = true;
    return child;
  }

  template <class Number>
  uint32_t place(const BuildNode& node, uint32_t depth, const Number& number) {
    bvh_.depth = std::max(bvh_.depth, depth);
    if (depth > rl::RL_BVH_MAX_DEPTH) {
      throw std::runtime_error(
          fmt::format("a hierarchy deeper than {} nodes", rl::RL_BVH_MAX_DEPTH));
    }
    if (node.isLeaf) return number(node);
    const auto index = static_cast<uint32_t>(bvh_.nodes.size());
    bvh_.nodes.push_back(nodeOfNothing());
    for (int side = 0; side < 2; ++side) {
      if (node.children[side] == nullptr) continue;
      Child child;
      child.exists = true;
      child.box = node.boxes[side];
      child.number = place(*node.children[side], depth + 1, number);
      setChild(index, side, child);
    }
    return index;
  }

  RTCDevice device_;
  const BvhInput& in_;
  Bvh bvh_;
  std::vector<Box> geometryBoxes_;
};

}  // namespace

size_t Bvh::bytes() const {
  return nodes.size() * sizeof(nodes[0]) + triangles.size() * sizeof(triangles[0]) +
         roots.size() * sizeof(roots[0]);
}

Bvh buildBvh(RTCDevice device, const BvhInput& input) { return Builder(device, input).build(); }

}  // namespace restlab
