// Scenes and rays that tell two tracers apart, and what explains a difference between them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/dialect/types.h"
#include "core/scene/compiled_scene.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {

// Within 1e-4 of an edge, as a share of the triangle.
bool isNearEdge(const rl::Hit& hit);

// Closest hits of the same rays by Embree and by another tracer.
struct RayAgreement {
  uint64_t rays = 0, hits = 0, same = 0;
  uint64_t ties = 0;         // two surfaces in one place
  uint64_t edges = 0;        // within 1e-4 of an edge of one of the triangles
  uint64_t grazing = 0;      // the same triangle, almost along its plane: t is ill-conditioned
  uint64_t starts = 0;       // on a surface, to rounding: only one of the two has hit it
  uint64_t unexplained = 0;  // all others
  std::string first;         // of those

  void add(const rl::Ray& ray, const rl::Hit& embree, const rl::Hit& other);
  double explainedShare() const { return double(ties + edges + grazing + starts) / double(rays); }
  std::string text() const;
};

// Where rays start: the scene's bounds, about its origin. A flat scene has bounds as high as they
// are long: what starts in its plane starts on its surface.
std::array<glm::vec3, 2> startBounds(const CompiledScene& scene);

// A closed ball about `at`, the scene centred there.
struct ClosedBall {
  explicit ClosedBall(const glm::dvec3& at);
  std::shared_ptr<const CompiledScene> scene;
  // From inside to corners and to places on edges: none must get out (hit another instance than 0).
  std::vector<rl::Ray> raysAtEdges(size_t count, uint64_t seed) const;

 private:
  MeshGeometry mesh_;
  glm::vec3 centre_{0.0f};
};

// Veils of a quarter's coverage, instances of one mesh and one of its own, before a solid block.
std::shared_ptr<const CompiledScene> veils();
// A ray whose span (tMax 1) ends among them or behind the block.
rl::Ray rayThroughVeils(const CompiledScene& scene, Inputs& inputs);

}  // namespace restlab::unit
