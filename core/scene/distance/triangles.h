// The triangles of a scene as one closed surface, in world space.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Corners at one place are one position. Triangles have three of them.
struct ClosedTriangles {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  glm::dvec3 low{0.0}, high{0.0};
};

// Stand-ins of shapes count. Throws Error (badInput), without a file: there is no triangle, or an
// edge has not as many triangles on one side as on the other.
ClosedTriangles closedTriangles(const Scene& scene);

}  // namespace restlab
