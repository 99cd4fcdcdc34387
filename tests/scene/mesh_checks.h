// Geometry checks of scenes for tests: world triangles, closedness, volume, rays by brute force.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab::test {

struct WorldTriangle {
  glm::dvec3 p0, p1, p2;
  uint32_t instance = 0;
  glm::dvec3 areaNormal() const { return 0.5 * glm::cross(p1 - p0, p2 - p0); }
};

// Triangles of the instances whose name starts with `prefix` ("": all), in world space.
std::vector<WorldTriangle> worldTriangles(const Scene& scene, const std::string& prefix = "");

// Returns "" when the surface is closed and consistently oriented: every edge, by exact position,
// is traversed equally often in both directions. Else describes the first edge that is not.
std::string openEdge(const std::vector<WorldTriangle>& triangles);

// Volume inside a closed surface, m^3; negative when its faces look inwards.
double signedVolume(const std::vector<WorldTriangle>& triangles);

struct WorldHit {
  double t = 0.0;
  const WorldTriangle* triangle = nullptr;
};
// Finds the nearest triangle along origin + t dir, t > 0.
std::optional<WorldHit> nearestHit(const std::vector<WorldTriangle>& triangles,
                                   const glm::dvec3& origin, const glm::dvec3& dir);

// Direction (not unit) through film position (x, y) in [0, 1]^2, (0, 0) the upper left corner.
glm::dvec3 cameraDirection(const SceneCamera& camera, double x, double y, double aspect);

// Returns the first instance of that name; throws std::invalid_argument if there is none.
const MeshInstance& instanceNamed(const Scene& scene, const std::string& name);

}  // namespace restlab::test
