// Bodies that light travels through, and which of them fills a place where several overlap.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Corners of an axis-aligned box in the world, metres.
struct BodyBox {
  glm::dvec3 low{0.0}, high{0.0};

  bool holds(const glm::dvec3& p) const {
    return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
  }
};

struct Bodies {
  // Rank of each instance: 0 for no body, else a unique number from 1 to the number of bodies.
  // Where bodies overlap, the greatest rank fills the place. Sorted by SceneMaterial::priority,
  // then by the size of the box, the smallest last, so that a body inside another one wins.
  std::vector<uint32_t> rank;
  // SceneData::bodies: two by rank. Empty if there is no body.
  std::vector<glm::vec4> media;
  // Boxes by instance; valid for bodies only.
  std::vector<BodyBox> boxes;
  // True if the boxes of two bodies touch or overlap.
  bool meet = false;
};

// Returns whether light enters the volume behind the surface: false for thin sheets and metal.
bool isBody(const rl::Material& material);

Bodies findBodies(const Scene& scene);

// Returns whether the body of the instance may touch or overlap another one, judged by boxes.
bool bodyMeetsAnother(const Bodies& bodies, size_t instance);

// Returns the ranks of the bodies that contain a point (world, metres), greatest first; 0 ends the
// list. At most four; a rank appears once for each shell of its mesh around the point. Traces three
// rays and takes the median answer; time grows with the triangles of all bodies whose box contains
// the point.
glm::uvec4 bodiesAt(const Scene& scene, const Bodies& bodies, const glm::dvec3& posW);

}  // namespace restlab
