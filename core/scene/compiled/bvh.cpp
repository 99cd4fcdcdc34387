#include "core/scene/compiled/bvh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "core/backend/embree.h"
#include "core/base/error.h"
#include "core/dialect/order.h"
#include "core/scene/compiled/instance_box.h"

namespace restlab {

namespace {

constexpr uint32_t kLeafSize = 4;
constexpr uint32_t kWidth = 4;  // children per node
// Memory for pieces of split triangles, as a multiple of the number of triangles. The builder deals
// it out by the size of parts of the scene, not by need: too little leaves bad trees where thin
// triangles cross.
constexpr size_t kSplitRoom = 4;

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};
  void add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

// Node of the builder's tree, in the builder's memory.
struct BuildNode {
  bool isLeaf = false;
  BuildNode* children[kWidth] = {};
  Box boxes[kWidth];
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

struct Child {
  uint32_t number = 0;
  Box box;
};

// Quantises the bounds of the children along one axis to bytes; returns false if the grid is too
// fine. Computes the sums as the kernel does, in its precision: rounding never moves a child out of
// its bounds.
bool quantise(const std::vector<Child>& children, int axis, float origin, uint32_t exponent,
              uint32_t& low, uint32_t& high) {
  const float cell = std::bit_cast<float>(exponent << 23);
  low = high = 0;
  for (uint32_t k = 0; k < children.size(); ++k) {
    const Box& box = children[k].box;
    const auto cells = [&](float at) {
      return cell > 0.0f ? (double(at) - double(origin)) / double(cell) : 0.0;
    };
    int first = static_cast<int>(std::clamp(std::floor(cells(box.low[axis])), 0.0, 255.0));
    int last = static_cast<int>(std::clamp(std::ceil(cells(box.high[axis])), 0.0, 256.0));
    while (first > 0 && origin + float(first) * cell > box.low[axis]) --first;
    while (last <= 255 && origin + float(last) * cell < box.high[axis]) ++last;
    if (last > 255) return false;
    low |= static_cast<uint32_t>(first) << (8 * k);
    high |= static_cast<uint32_t>(last) << (8 * k);
  }
  return true;
}

BvhNode nodeOf(const std::vector<Child>& children) {
  BvhNode node;
  Box box;
  for (uint32_t k = 0; k < children.size(); ++k) {
    node.children[k] = children[k].number;
    box.add(children[k].box.low);
    box.add(children[k].box.high);
  }
  if (children.empty()) return node;
  node.origin = box.low;
  for (int axis = 0; axis < 3; ++axis) {
    const float cell = (box.high[axis] - box.low[axis]) / 255.0f;
    // Exponent 254 is the largest of a finite float: the box then takes the whole grid.
    uint32_t exponent = std::min(std::bit_cast<uint32_t>(cell) >> 23, 254u);
    while (
        !quantise(children, axis, node.origin[axis], exponent, node.low[axis], node.high[axis])) {
      if (exponent == 254) {
        node.low[axis] = 0;
        node.high[axis] = 0xffffffffu;
        break;
      }
      ++exponent;
    }
    node.exponents |= exponent << (8 * axis);
  }
  return node;
}

// Computes the bounds of a triangle on either side of a plane, within the bounds left by earlier
// splits. A point where an edge meets the plane is moved out by its rounding error.
void splitTriangle(const RTCBuildPrimitive* primitive, unsigned int axis, float position,
                   RTCBounds* left, RTCBounds* right, void* user) {
  const BvhTriangle& triangle = static_cast<const BvhTriangle*>(user)[primitive->primID];
  const glm::vec3 corners[3] = {triangle.p0, triangle.p1, triangle.p2};
  const int dim = static_cast<int>(axis);
  Box sides[2];
  for (int i = 0; i < 3; ++i) {
    const glm::vec3 a = corners[i], b = corners[(i + 1) % 3];
    if (a[dim] <= position) sides[0].add(a);
    if (a[dim] >= position) sides[1].add(a);
    if ((a[dim] < position) == (b[dim] < position) || a[dim] == b[dim]) continue;
    const glm::vec3 at = a + (b - a) * ((position - a[dim]) / (b[dim] - a[dim]));
    const glm::vec3 error = 4e-7f * glm::max(glm::abs(a), glm::abs(b));
    for (Box& side : sides) {
      side.add(at - error);
      side.add(at + error);
    }
  }
  const glm::vec3 low(primitive->lower_x, primitive->lower_y, primitive->lower_z);
  const glm::vec3 high(primitive->upper_x, primitive->upper_y, primitive->upper_z);
  for (int k = 0; k < 2; ++k) {
    glm::vec3 from = glm::max(sides[k].low, low), to = glm::min(sides[k].high, high);
    (k == 0 ? to : from)[dim] = position;
    // Rounding may leave nothing of a sliver: avoid inverted bounds.
    to = glm::max(from, to);
    RTCBounds& bounds = k == 0 ? *left : *right;
    bounds.lower_x = from.x;
    bounds.lower_y = from.y;
    bounds.lower_z = from.z;
    bounds.upper_x = to.x;
    bounds.upper_y = to.y;
    bounds.upper_z = to.z;
  }
}

struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

class Builder {
 public:
  Builder(RTCDevice device, const BvhInput& input) : device_(device), in_(input) {}

  Bvh build() {
    bvh_.roots.assign(in_.geometries.size(), rl::RL_INVALID);
    newNode();
    std::vector<Triangle> world;
    std::vector<uint32_t> placed;  // indices of instances with a transform
    for (uint32_t i = 0; i < in_.instances.size(); ++i) {
      const rl::Instance& inst = in_.instances[i];
      if (isShape(inst)) placed.push_back(i);
      if (in_.geometries[inst.geometry].triangleCount == 0) continue;
      if ((inst.flags & rl::RL_INSTANCE_IDENTITY) == 0) {
        placed.push_back(i);
        continue;
      }
      const bool isTransparent = (inst.flags & rl::RL_INSTANCE_ALPHA) != 0;
      addTriangles(world, inst.geometry, i, isTransparent);
    }
    std::vector<Child> trees = treeOfTriangles(world);
    for (const uint32_t i : placed)
      if (!isShape(in_.instances[i])) buildGeometry(in_.instances[i].geometry);
    for (const Child& tree : treeOfInstances(placed)) trees.push_back(tree);
    bvh_.records[0] = std::bit_cast<BvhRecord>(nodeOf(trees));
    return std::move(bvh_);
  }

 private:
  using Triangle = BvhTriangle;

  bool isShape(const rl::Instance& inst) const {
    return in_.geometries[inst.geometry].shape != rl::RL_SHAPE_TRIANGLES;
  }

  // Returns the number of the next record; throws if `count` more do not fit.
  uint32_t nextRecord(uint32_t count) const {
    const size_t next = bvh_.records.size();
    if (next + count > rl::RL_BVH_LEAF_FIRST) {
      throw Error(ExitCode::deviceUnavailable,
                  fmt::format("the scene has too many triangles: its hierarchy has more than {} "
                              "nodes and triangles",
                              rl::RL_BVH_LEAF_FIRST));
    }
    return static_cast<uint32_t>(next);
  }

  uint32_t newNode() {
    const uint32_t index = nextRecord(1);
    bvh_.records.push_back(std::bit_cast<BvhRecord>(BvhNode()));
    ++bvh_.nodeCount;
    return index;
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

  Box boxOf(const rl::Instance& inst) const {
    const Box& mesh = geometryBoxes_.at(inst.geometry);
    const std::array<glm::vec3, 2> box = boxOfInstance(inst, {mesh.low, mesh.high});
    return {box[0], box[1]};
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
    const std::vector<Child> tree = treeOfTriangles(triangles);
    if ((tree.front().number & rl::RL_BVH_KIND) == 0u) {
      bvh_.roots[geometry] = tree.front().number;
      return;
    }
    bvh_.roots[geometry] = newNode();
    bvh_.records[bvh_.roots[geometry]] = std::bit_cast<BvhRecord>(nodeOf(tree));
  }

  // Returns the tree as a single child for the node above; empty if there are no triangles.
  std::vector<Child> treeOfTriangles(const std::vector<Triangle>& triangles) {
    std::vector<Box> boxes;
    for (const Triangle& t : triangles) boxes.push_back(boxOf(t));
    // A triangle in two leaves would dim a shadow ray twice if it is transparent.
    const bool mayRepeat =
        std::none_of(in_.instances.begin(), in_.instances.end(),
                     [](const rl::Instance& i) { return (i.flags & rl::RL_INSTANCE_ALPHA) != 0; });
    const Triangle* splits = mayRepeat ? triangles.data() : nullptr;
    return tree(boxes, kLeafSize, splits, [&](const BuildNode& leaf) {
      const uint32_t first = nextRecord(leaf.count);
      for (uint32_t i = 0; i < leaf.count; ++i)
        bvh_.records.push_back(std::bit_cast<BvhRecord>(triangles[leaf.items[i]]));
      bvh_.triangleCount += leaf.count;
      return rl::RL_BVH_LEAF | leaf.count << rl::RL_BVH_LEAF_COUNT_SHIFT | first;
    });
  }

  std::vector<Child> treeOfInstances(const std::vector<uint32_t>& instances) {
    std::vector<Box> boxes;
    for (const uint32_t i : instances) {
      if (!isShape(in_.instances[i])) {
        boxes.push_back(boxOf(in_.instances[i]));
        continue;
      }
      const RTCBounds& b = in_.shapeBoxes[i];
      boxes.push_back({{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}});
    }
    return tree(boxes, 1, nullptr, [&](const BuildNode& leaf) {
      const uint32_t i = instances[leaf.items[0]];
      return (isShape(in_.instances[i]) ? rl::RL_BVH_KIND : rl::RL_BVH_INSTANCE) | i;
    });
  }

  // `number` returns the child number of a leaf. `splits`: the triangles of the boxes, if planes
  // may split them (spatial splits, Stich et al. 2009); null: boxes stay whole.
  template <class Number>
  std::vector<Child> tree(const std::vector<Box>& boxes, uint32_t leafSize, const Triangle* splits,
                          const Number& number) {
    Child child;
    if (boxes.empty()) return {};
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
    if (splits != nullptr) {
      arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
      arguments.splitPrimitive = splitTriangle;
      arguments.userPtr = const_cast<Triangle*>(splits);
      primitives.resize(kSplitRoom * boxes.size());
    }
    arguments.maxBranchingFactor = kWidth;
    arguments.maxDepth = rl::RL_BVH_MAX_DEPTH;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = leafSize;
    arguments.bvh = memory.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = boxes.size();
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
    return {child};
  }

  template <class Number>
  uint32_t place(const BuildNode& node, uint32_t depth, const Number& number) {
    bvh_.depth = std::max(bvh_.depth, depth);
    if (depth > rl::RL_BVH_MAX_DEPTH) {
      throw std::runtime_error(
          fmt::format("a hierarchy deeper than {} nodes", rl::RL_BVH_MAX_DEPTH));
    }
    if (node.isLeaf) return number(node);
    const uint32_t index = newNode();
    std::vector<Child> children;
    for (uint32_t k = 0; k < kWidth; ++k) {
      if (node.children[k] == nullptr) continue;
      children.push_back({place(*node.children[k], depth + 1, number), node.boxes[k]});
    }
    bvh_.records[index] = std::bit_cast<BvhRecord>(nodeOf(children));
    return index;
  }

  RTCDevice device_;
  const BvhInput& in_;
  Bvh bvh_;
  std::vector<Box> geometryBoxes_;
};

}  // namespace

size_t Bvh::bytes() const {
  return records.size() * sizeof(records[0]) + roots.size() * sizeof(roots[0]);
}

Bvh buildBvh(RTCDevice device, const BvhInput& input) { return Builder(device, input).build(); }

}  // namespace restlab
