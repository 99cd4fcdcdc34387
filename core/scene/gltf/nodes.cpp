#include "core/scene/gltf/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>

#include "core/scene/linear_map.h"

namespace restlab::gltf {
namespace {

constexpr size_t kNoParent = SIZE_MAX;

// Returns the parent of every node. Fails on a node with two parents and on loops.
std::vector<size_t> findParents(const tinygltf::Model& model, Report& report) {
  std::vector<size_t> parents(model.nodes.size(), kNoParent);
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const std::vector<int>& children = model.nodes[i].children;
    for (size_t c = 0; c < children.size(); ++c) {
      size_t& parent = parents[static_cast<size_t>(children[c])];
      if (parent != kNoParent) {
        report.fail(fmt::format("nodes[{}].children[{}]", i, c),
                    fmt::format("node {} is already a child of nodes[{}]; nodes form a tree",
                                children[c], parent));
      }
      parent = i;
    }
  }
  // Each node has at most one parent: a node that no root reaches is on or below a loop.
  std::vector<size_t> stack;
  std::vector<bool> reached(model.nodes.size());
  for (size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == kNoParent) stack.push_back(i);
  }
  while (!stack.empty()) {
    const size_t node = stack.back();
    stack.pop_back();
    reached[node] = true;
    for (const int child : model.nodes[node].children) stack.push_back(static_cast<size_t>(child));
  }
  for (size_t i = 0; i < reached.size(); ++i) {
    if (reached[i]) continue;
    size_t onLoop = i;
    for (size_t step = 0; step < parents.size(); ++step) onLoop = parents[onLoop];
    report.fail(fmt::format("nodes[{}].children", onLoop),
                "the node is its own descendant; nodes form a tree");
  }
  return parents;
}

std::vector<size_t> findRoots(const tinygltf::Model& model, const std::vector<size_t>& parents,
                              Report& report) {
  std::vector<size_t> roots;
  if (model.scenes.empty()) {
    for (size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] == kNoParent) roots.push_back(i);
    }
    report.warn("no scene", "scenes", "the file has none; all nodes are drawn");
    return roots;
  }
  const size_t scene = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
  std::vector<bool> listed(model.nodes.size());
  const std::vector<int>& nodes = model.scenes[scene].nodes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const size_t node = static_cast<size_t>(nodes[i]);
    const std::string place = fmt::format("scenes[{}].nodes[{}]", scene, i);
    if (listed[node]) report.fail(place, fmt::format("node {} is listed twice", node));
    if (parents[node] != kNoParent) {
      report.fail(place, fmt::format("node {} is a child of nodes[{}]; a root expected", node,
                                     parents[node]));
    }
    listed[node] = true;
    roots.push_back(node);
  }
  return roots;
}

glm::dvec3 vec3Of(const std::vector<double>& v, glm::dvec3 otherwise) {
  return v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : otherwise;
}

struct LocalTransform {
  glm::dmat4 matrix;
  glm::dmat3 regular, rotation;  // see PlacedNode
  bool isScalePositive;
};

LocalTransform partsOf(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const bool isRegular = regularity(linear) > kSmallestRegularity;
  return {matrix, isRegular ? linear : nearestRotation(linear), nearestRotation(linear),
          isRegular && glm::determinant(linear) > 0.0};
}

LocalTransform localTransform(const tinygltf::Model& model, size_t index, Report& report) {
  const tinygltf::Node& node = model.nodes[index];
  if (node.matrix.size() == 16) {
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        matrix[column][row] = node.matrix[static_cast<size_t>(4 * column + row)];
      }
    }
    const glm::dvec4 lastRow(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w);
    constexpr double kTolerance = 1e-6;
    if (glm::length(lastRow - glm::dvec4(0, 0, 0, 1)) > kTolerance) {
      report.fail(placeOfNode(model, index) + ".matrix",
                  fmt::format("the last row is ({:g}, {:g}, {:g}, {:g}); (0, 0, 0, 1) expected",
                              lastRow.x, lastRow.y, lastRow.z, lastRow.w));
    }
    for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1.0 : 0.0;
    return partsOf(matrix);
  }
  glm::dvec4 rotation(0, 0, 0, 1);
  if (node.rotation.size() == 4) {
    rotation = {node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]};
    const double length = glm::length(rotation);
    const std::string place = placeOfNode(model, index) + ".rotation";
    if (!(length > 1e-6)) report.fail(place, "the quaternion has no length; unit length expected");
    constexpr double kTolerance = 1e-3;
    if (std::abs(length - 1.0) > kTolerance) {
      report.warn("rotation length", place,
                  fmt::format("the quaternion has length {:g}; it is normalised", length));
    }
  }
  const glm::dvec3 scale = vec3Of(node.scale, glm::dvec3(1.0));
  glm::dvec3 regularScale = scale;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(scale[axis]) > kSmallestScale)) regularScale[axis] = 1.0;
  const glm::dvec3 nowhere(0.0);
  return {composeTransform(vec3Of(node.translation, nowhere), rotation, scale),
          glm::dmat3(composeTransform(nowhere, rotation, regularScale)),
          glm::dmat3(composeTransform(nowhere, rotation, glm::dvec3(1.0))),
          std::min({scale.x, scale.y, scale.z}) > kSmallestScale};
}

// Rescales extreme axes, so that products along long chains stay in range.
glm::dmat3 inRange(const glm::dmat3& linear) {
  constexpr double kLargest = 1e60;
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, glm::length(linear[axis]));
  return most > kLargest || most < 1.0 / kLargest ? linear / most : linear;
}

}  // namespace

std::string placeOfNode(const tinygltf::Model& model, size_t node) {
  const std::string& name = model.nodes[node].name;
  return name.empty() ? fmt::format("nodes[{}]", node)
                      : fmt::format("nodes[{}] ('{}')", node, name);
}

glm::dmat3 carriedAxes(const PlacedNode& placed) {
  if (placed.isOwnScalePositive) return glm::dmat3(placed.toWorld);
  return regularity(placed.unscaled) > kSmallestRegularity ? placed.unscaled
                                                           : nearestRotation(placed.unscaled);
}

glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dvec4& rotation,
                            const glm::dvec3& scale) {
  const glm::dquat quaternion(rotation.w, rotation.x, rotation.y, rotation.z);
  return glm::translate(glm::dmat4(1.0), translation) * glm::mat4_cast(glm::normalize(quaternion)) *
         glm::scale(glm::dmat4(1.0), scale);
}

std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, Report& report) {
  const std::vector<size_t> parents = findParents(model, report);
  std::vector<size_t> roots = findRoots(model, parents, report);
  std::vector<PlacedNode> placed;
  // Explicit stack: chains of nodes may be deeper than the call stack allows.
  std::vector<PlacedNode> stack;
  for (auto it = roots.rbegin(); it != roots.rend(); ++it) stack.push_back({*it, glm::dmat4(1.0)});
  while (!stack.empty()) {
    PlacedNode current = stack.back();
    stack.pop_back();
    const LocalTransform local = localTransform(model, current.node, report);
    current.toWorld = current.toWorld * local.matrix;
    current.unscaled = inRange(current.regular * local.rotation);
    current.regular = inRange(current.regular * local.regular);
    current.isOwnScalePositive =
        local.isScalePositive && regularity(glm::dmat3(current.toWorld)) > kSmallestRegularity;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        if (!(std::abs(current.toWorld[column][row]) <= FLT_MAX)) {
          report.fail(placeOfNode(model, current.node),
                      "its transform to the world is not finite in 32-bit floats");
        }
      }
    }
    const std::vector<int>& children = model.nodes[current.node].children;
    for (auto it = children.rbegin(); it != children.rend(); ++it) {
      stack.push_back({static_cast<size_t>(*it), current.toWorld, current.regular});
    }
    placed.push_back(current);
  }
  return placed;
}

}  // namespace restlab::gltf
