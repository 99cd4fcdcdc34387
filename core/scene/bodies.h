// Bodies that light travels through, and which of them fills a place that several claim.
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
  // Rank of each instance; 0: no body. Else 1 to the number of bodies, each once: where bodies
  // overlap, the greatest rank fills the place. Sorted by SceneMaterial::priority, then by the size
  // of the box, the smallest last, so that a body inside another one wins.
  std::vector<uint32_t> rank;
  // Absorption (m^-1) and index of refraction by rank; [0] is air. Empty where there is no body.
  std::vector<glm::vec4> media;
  // Boxes by instance, of bodies alone.
  std::vector<BodyBox> boxes;
  // Two of them touch or overlap, as far as their boxes tell.
  bool meet = false;
};

// Does light enter what the material bounds? Not behind a thin sheet, nor through metal.
bool isBody(const rl::Material& material);

Bodies findBodies(const Scene& scene);

// May the body of that instance touch or overlap another one, as far as boxes tell?
bool bodyMeetsAnother(const Bodies& bodies, size_t instance);

// Ranks of the bodies that hold a point (world, metres), the greatest first; 0: no more. At most
// four; a rank stands there once for each shell of its mesh around the point. By the surfaces along
// three rays, of which the middle answer counts; takes time by the triangles of all bodies whose
// box holds the point.
glm::uvec4 bodiesAt(const Scene& scene, const Bodies& bodies, const glm::dvec3& posW);

}  // namespace restlab
