#include "tests/unit/ray_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"

namespace restlab::unit {

bool isNearEdge(const rl::Hit& hit) {
  if (hit.instance == rl::RL_INVALID) return false;
  return std::min({hit.bary.x, hit.bary.y, 1.0f - hit.bary.x - hit.bary.y}) < 1e-4f;
}

void RayAgreement::add(const rl::Ray& ray, const rl::Hit& embree, const rl::Hit& other) {
  const rl::Hit &a = embree, &b = other;
  const bool hitsA = a.instance != rl::RL_INVALID, hitsB = b.instance != rl::RL_INVALID;
  // Distances are rounded relative to the size of the coordinates.
  const glm::vec3 o = glm::abs(ray.origin);
  const float atOrigin = 2e-5f * std::max({o.x, o.y, o.z});
  const bool isAsFar = hitsA && hitsB && std::abs(a.t - b.t) <= 1e-4f * a.t + atOrigin;
  const bool isSame = a.instance == b.instance && (!hitsA || a.primitive == b.primitive);
  ++rays;
  hits += hitsA ? 1 : 0;
  if (isSame && (!hitsA || isAsFar)) {
    ++same;
  } else if (isAsFar) {
    ++ties;
  } else if (isSame && std::abs(a.t - b.t) <= 1e-2f * a.t) {
    ++grazing;
  } else if ((hitsA && a.t <= atOrigin) || (hitsB && b.t <= atOrigin)) {
    ++starts;
  } else if (isNearEdge(a) || isNearEdge(b)) {
    ++edges;
  } else if (unexplained++ == 0) {
    first =
        fmt::format("({} {} {}) -> ({} {} {}): Embree {} {} t {}, the other {} {} t {}",
                    ray.origin.x, ray.origin.y, ray.origin.z, ray.dir.x, ray.dir.y, ray.dir.z,
                    int(a.instance), int(a.primitive), a.t, int(b.instance), int(b.primitive), b.t);
  }
}

std::string RayAgreement::text() const {
  return fmt::format(
      "{} rays, {} hits, {} same, {} ties, {} at edges, {} grazing, {} at their start, {} "
      "unexplained {}",
      rays, hits, same, ties, edges, grazing, starts, unexplained, first);
}

std::array<glm::vec3, 2> startBounds(const CompiledScene& scene) {
  std::array<glm::dvec3, 2> bounds = worldBounds(scene.source());
  const glm::dvec3 size = bounds[1] - bounds[0];
  const double longest = std::max({size.x, size.y, size.z});
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > 0.0) continue;
    bounds[0][axis] -= 0.5 * longest;
    bounds[1][axis] += 0.5 * longest;
  }
  return {glm::vec3(bounds[0] - scene.origin()), glm::vec3(bounds[1] - scene.origin())};
}

ClosedBall::ClosedBall(const glm::dvec3& at) : mesh_(builtin::sphere("ball", at, 1.0, 5, true)) {
  builtin::SceneBuilder builder("closed");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  builder.add(mesh_, id);
  // A counterweight keeps the scene's origin at the world's, so coordinates stay large.
  if (at != glm::dvec3(0.0)) builder.add(builtin::box("counterweight", -at - 0.01, -at + 0.01), id);
  scene = CompiledScene::build(builder.finish());
  centre_ = glm::vec3(at);
}

std::vector<rl::Ray> ClosedBall::raysAtEdges(size_t count, uint64_t seed) const {
  Inputs inputs(seed);
  const glm::vec3 origin(scene->origin());
  std::vector<rl::Ray> rays(count);
  for (size_t i = 0; i < count; ++i) {
    const glm::uvec3 t = mesh_.triangles[inputs.below(uint32_t(mesh_.triangles.size()))];
    const float u = i % 4 == 0 ? 0.0f : inputs.uniform();  // a corner, or a point on an edge
    const glm::vec3 target =
        mesh_.positions[t.x] + u * (mesh_.positions[t.y] - mesh_.positions[t.x]);
    const glm::vec3 from = centre_ + 0.5f * inputs.uniform() * inputs.direction();
    rays[i] = {from - origin, 0.0f, target - from, 3e38f};
  }
  return rays;
}

std::shared_ptr<const CompiledScene> veils() {
  builtin::SceneBuilder builder("veils");
  rl::Material veil = builtin::lambert(glm::vec3(0.5f));
  veil.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  veil.alpha = 0.25f;
  const uint32_t id = builder.addMaterial("veil", veil),
                 solid = builder.addMaterial("solid", builtin::lambert(glm::vec3(0.5f)));
  const uint32_t mesh = builder.addGeometry(builtin::sphere("ball", {0, 0, 0}, 1.0, 2, false));
  for (const double x : {0.0, 3.0}) {
    builder.place("ball", mesh, id, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0, 0)));
  }
  builder.add(builtin::sphere("own", {6, 0, 0}, 1.0, 2, false), id);
  builder.add(builtin::box("block", {8, -1, -1}, {9, 1, 1}), solid);
  return CompiledScene::build(builder.finish());
}

rl::Ray rayThroughVeils(const CompiledScene& scene, Inputs& inputs) {
  glm::vec3 from, to;
  from.x = inputs.uniform(-8.0f, -6.0f);
  from.y = inputs.uniform(-1.0f, 1.0f);
  from.z = inputs.uniform(-1.0f, 1.0f);
  to.x = inputs.uniform(1.0f, 10.0f);
  to.y = inputs.uniform(-1.0f, 1.0f);
  to.z = inputs.uniform(-1.0f, 1.0f);
  return {from - glm::vec3(scene.origin()), 0.0f, to - from, 1.0f};
}

}  // namespace restlab::unit
