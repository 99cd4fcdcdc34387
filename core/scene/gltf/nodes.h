// The node hierarchy: which nodes are drawn, and where.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"

namespace restlab::gltf {

struct PlacedNode {
  size_t node;
  glm::dmat4 toWorld;  // finite
  // Linear part with every scale of 0 read as 1, up to a positive factor: invertible. The
  // determinant tells whether the node is mirrored.
  glm::dmat3 regular{1.0};
  // `regular` with the node's own scale read as 1: the axes of a camera or light on the node.
  glm::dmat3 unscaled{1.0};
  bool isOwnScalePositive = true;  // also: no scale above it is 0
};

// Linear part for a camera or light of the node: scales have no effect, except mirrors and shears
// of the nodes above. Invertible.
glm::dmat3 carriedAxes(const PlacedNode& placed);

// Places the nodes of the default scene (or the first; or all, when there is none) in depth-first
// order. Fails on loops, nodes with two parents and transforms that are not finite or not affine.
std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, Report& report);

// "nodes[3] ('lamp')" for error lines.
std::string placeOfNode(const tinygltf::Model& model, size_t node);

// Translation x rotation (quaternion x, y, z, w of any length but 0) x scale.
glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dvec4& rotation,
                            const glm::dvec3& scale);

}  // namespace restlab::gltf
