// Scenes and rays that reveal differences between two tracers, and the explained differences.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/dialect/types.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {

// Returns whether the hit is within 1e-4 of an edge, relative to the triangle.
bool isNearEdge(const rl::Hit& hit);

// Closest hits of the same rays by Embree and by another tracer.
struct RayAgreement {
  uint64_t rays = 0, hits = 0, same = 0;
  uint64_t ties = 0;         // two surfaces at the same place
  uint64_t edges = 0;        // within 1e-4 of an edge of one of the triangles
  uint64_t grazing = 0;      // the same triangle, almost along its plane: t is ill-conditioned
  uint64_t starts = 0;       // start on a surface, to rounding: only one tracer hits it
  uint64_t unexplained = 0;  // all other differences
  std::string first;         // description of the first unexplained one

  void add(const rl::Ray& ray, const rl::Hit& embree, const rl::Hit& other);
  double explainedShare() const { return double(ties + edges + grazing + starts) / double(rays); }
  std::string text() const;
};

// Bounds for ray origins: the scene's bounds, about its origin. A flat scene gets bounds as high as
// they are long: a ray that starts in its plane starts on its surface.
std::array<glm::vec3, 2> startBounds(const CompiledScene& scene);

// A closed ball at `at`, the centre of the scene.
struct ClosedBall {
  explicit ClosedBall(const glm::dvec3& at);
  std::shared_ptr<const CompiledScene> scene;
  // Rays from inside to corners and to points on edges: none may get out (hit another instance than
  // 0).
  std::vector<rl::Ray> raysAtEdges(size_t count, uint64_t seed) const;

 private:
  MeshGeometry mesh_;
  glm::vec3 centre_{0.0f};
};

// Veils of a quarter's coverage in front of a solid block: instances of one mesh, and a mesh used
// once.
std::shared_ptr<const CompiledScene> veils();
// A ray whose span (tMax 1) ends among the veils or behind the block.
rl::Ray rayThroughVeils(const CompiledScene& scene, Inputs& inputs);

}  // namespace restlab::unit
