// The node hierarchy: which nodes are drawn, and where.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/gltf_document.h"
#include "core/scene/gltf_report.h"

namespace restlab::gltf {

struct PlacedNode {
  size_t node;
  glm::dmat4 toWorld;  // finite
};

// Nodes of the default scene (or the first; or all, when there is none) in depth-first order. Fails
// on loops, nodes with two parents and transforms that are not finite or not affine.
std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, Report& report);

// "nodes[3] ('lamp')" for error lines.
std::string placeOfNode(const tinygltf::Model& model, size_t node);

// How far a transform is from losing a dimension: |determinant| over the product of the lengths of
// the axes, 0 when an axis has no length. 1 for any rotation with any scale.
double regularity(const glm::dmat4& transform);
inline constexpr double kSmallestRegularity = 1e-9;

// Translation x rotation (quaternion x, y, z, w of any length but 0) x scale.
glm::dmat4 composeTransform(const glm::dvec3& translation, const glm::dvec4& rotation,
                            const glm::dvec3& scale);

}  // namespace restlab::gltf
