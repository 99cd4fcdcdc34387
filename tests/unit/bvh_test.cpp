// The project's own hierarchy against Embree, ray by ray, and its watertightness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace rl {

// The dialect with traceRay() on the project's own hierarchy.
struct BvhCtx {
  static constexpr uint kFeatures = RL_FEATURE_ALL;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;

#include "core/dialect/order.glsl"
#include "core/dialect/trace_bvh.glsl"
};

}  // namespace rl

namespace restlab::unit {
namespace {

// One scene behind both.
struct BothTracers {
  explicit BothTracers(const std::shared_ptr<const CompiledScene>& scene)
      : bound(scene->bindBvh()), embree(scene), own{scene->data(), embree.frame, counters} {}
  const Bvh& bound;
  rl::CpuKernelCounters counters;
  Dialect<> embree;
  rl::BvhCtx own;
};

rl::Ray rayFrom(const glm::vec3& origin, const glm::vec3& dir, float tMax = 3e38f) {
  return {origin, 0.0f, dir, tMax};
}

struct Comparison {
  uint64_t rays = 0, hits = 0, same = 0;
  uint64_t nearEdge = 0, ties = 0;  // what explains the others
  std::string unexplained;          // the first one
  uint64_t unexplainedCount = 0;
};

// Within 1e-4 of an edge, as a share of the triangle.
bool isNearEdge(const rl::Hit& hit) {
  if (hit.instance == rl::RL_INVALID) return false;
  return std::min({hit.bary.x, hit.bary.y, 1.0f - hit.bary.x - hit.bary.y}) < 1e-4f;
}

void compareRay(BothTracers& both, const rl::Ray& ray, uint32_t key, Comparison& c, rl::Hit& out) {
  rl::Hit a, b;
  both.embree->traceRay(ray, rl::RL_RAY_PATH, key, a);
  both.own.traceRay(ray, rl::RL_RAY_PATH, key, b);
  out = a;
  ++c.rays;
  if (a.instance != rl::RL_INVALID) ++c.hits;
  const bool isSame =
      a.instance == b.instance && (a.instance == rl::RL_INVALID || a.primitive == b.primitive);
  // Distances are rounded at the size of the coordinates.
  const glm::vec3 o = glm::abs(ray.origin);
  const float tolerance = 1e-4f * a.t + 2e-5f * std::max({o.x, o.y, o.z});
  const bool closeEnough = a.instance == rl::RL_INVALID || std::abs(a.t - b.t) <= tolerance;
  const bool isTie =  // two surfaces in one place
      a.instance != rl::RL_INVALID && b.instance != rl::RL_INVALID &&
      std::abs(a.t - b.t) <= tolerance;
  if (isSame && closeEnough) {
    ++c.same;
  } else if (isTie) {
    ++c.ties;
  } else if (isNearEdge(a) || isNearEdge(b)) {
    ++c.nearEdge;
  } else if (c.unexplainedCount++ == 0) {
    char text[256];
    std::snprintf(text, sizeof text, "(%g %g %g) -> (%g %g %g): Embree %d %d t %g, own %d %d t %g",
                  ray.origin.x, ray.origin.y, ray.origin.z, ray.dir.x, ray.dir.y, ray.dir.z,
                  int(a.instance), int(a.primitive), a.t, int(b.instance), int(b.primitive), b.t);
    c.unexplained = text;
  }
}

// Camera-like rays from inside the scene's bounds, each followed along a random walk.
Comparison compareScene(const std::shared_ptr<const CompiledScene>& scene, uint64_t rays) {
  BothTracers both(scene);
  Inputs inputs(7);
  const auto bounds = worldBounds(scene->source());
  const glm::vec3 low(bounds[0] - scene->origin()), high(bounds[1] - scene->origin());
  Comparison c;
  while (c.rays < rays) {
    rl::Ray ray = rayFrom(
        low + (high - low) * glm::vec3(inputs.uniform(), inputs.uniform(), inputs.uniform()),
        inputs.direction());
    for (int bounce = 0; bounce < 4; ++bounce) {
      rl::Hit hit;
      compareRay(both, ray, inputs.bits(), c, hit);
      if (hit.instance == rl::RL_INVALID) break;
      const rl::Surface s = both.embree->surfaceLoad(hit, ray.dir);
      const glm::vec3 out = inputs.directionAbove(s.nGeoW);
      ray = rayFrom(both.embree->surfaceOffset(s.posW, s.nGeoW, s.posError, out), out);
    }
  }
  return c;
}

void expectAgreement(const Comparison& c, const std::string& name) {
  std::printf("%s: %llu rays, %llu hits, %llu same, %llu ties, %llu at edges, %llu unexplained\n",
              name.c_str(), static_cast<unsigned long long>(c.rays),
              static_cast<unsigned long long>(c.hits), static_cast<unsigned long long>(c.same),
              static_cast<unsigned long long>(c.ties), static_cast<unsigned long long>(c.nearEdge),
              static_cast<unsigned long long>(c.unexplainedCount));
  EXPECT_EQ(c.unexplainedCount, 0u) << name << ": " << c.unexplained;
  EXPECT_GT(c.hits, c.rays / 10) << name;
  EXPECT_LT(double(c.nearEdge + c.ties), 1e-2 * double(c.rays)) << name;
}

TEST(Bvh, AgreesWithEmbreeOnBuiltinScenes) {
  for (const std::string& name : builtinSceneNames()) {
    expectAgreement(compareScene(CompiledScene::build(makeBuiltinScene(name)), 50'000), name);
  }
}

TEST(BvhNightly, AgreesWithEmbreeOnBuiltinScenes) {
  for (const std::string& name : builtinSceneNames()) {
    expectAgreement(compareScene(CompiledScene::build(makeBuiltinScene(name)), 1'000'000), name);
  }
}

// Stretched, mirrored and rotated instances of one mesh, inside one another.
TEST(Bvh, AgreesWithEmbreeOnInstances) {
  Inputs inputs(3);
  builtin::SceneBuilder builder("instances");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  const uint32_t mesh = builder.addGeometry(builtin::sphere("ball", {0.3, 0, 0}, 1.0, 3, false));
  for (int i = 0; i < 300; ++i) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), 10.0 * glm::dvec3(inputs.direction()));
    m = glm::rotate(m, 6.28 * inputs.uniform(), glm::dvec3(inputs.direction()));
    builder.place("ball", mesh, id,
                  glm::scale(m, glm::dvec3(inputs.scale(0.05f, 3.0f), inputs.scale(0.05f, 3.0f),
                                           inputs.below(2) == 0 ? -1.0 : 1.0)));
  }
  builder.add(builtin::box("floor", {-20, -12, -20}, {20, -11, 20}), id);
  expectAgreement(compareScene(CompiledScene::build(builder.finish()), 200'000), "instances");
}

// Rays from inside a closed mesh, at its corners and along its edges: none gets out.
TEST(Bvh, ClosedMeshesAreWatertight) {
  for (const double distance : {0.0, 1e3}) {
    builtin::SceneBuilder builder("closed");
    const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
    const glm::dvec3 at = distance * glm::dvec3(0.6, -0.64, 0.48);
    const MeshGeometry mesh = builtin::sphere("ball", at, 1.0, 5, true);
    builder.add(mesh, id);
    if (distance > 0.0) builder.add(builtin::box("counterweight", -at - 0.01, -at + 0.01), id);
    BothTracers both(CompiledScene::build(builder.finish()));
    Inputs inputs(5);
    const glm::vec3 origin(both.embree.compiledScene->origin());
    uint64_t leaks = 0, rays = 0;
    for (int i = 0; i < 400'000; ++i) {
      const glm::uvec3 t = mesh.triangles[inputs.below(uint32_t(mesh.triangles.size()))];
      const float u = i % 4 == 0 ? 0.0f : inputs.uniform();  // a corner, or a place on an edge
      const glm::vec3 target =
          mesh.positions[t.x] + u * (mesh.positions[t.y] - mesh.positions[t.x]);
      const glm::vec3 from = glm::vec3(at) + 0.5f * inputs.uniform() * inputs.direction();
      rl::Hit hit;
      both.own.traceRay(rayFrom(from - origin, target - from), rl::RL_RAY_PATH, 0, hit);
      ++rays;
      if (hit.instance != 0u) ++leaks;
    }
    EXPECT_EQ(leaks, 0u) << "of " << rays << " at distance " << distance;
  }
}

// Any-hit rays: what Embree's filters multiply, the traversal multiplies; closest hits: what they
// let through, it lets through.
void compareTransparentSheets(uint64_t rays) {
  builtin::SceneBuilder builder("sheets");
  rl::Material veil = builtin::lambert(glm::vec3(0.5f));
  veil.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  veil.alpha = 0.25f;
  const uint32_t id = builder.addMaterial("veil", veil),
                 solid = builder.addMaterial("solid", builtin::lambert(glm::vec3(0.5f)));
  const uint32_t mesh = builder.addGeometry(builtin::sphere("ball", {0, 0, 0}, 1.0, 2, false));
  for (double x : {0.0, 3.0}) {
    builder.place("ball", mesh, id, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0, 0)));
  }
  builder.add(builtin::sphere("own", {6, 0, 0}, 1.0, 2, false), id);
  builder.add(builtin::box("block", {8, -1, -1}, {9, 1, 1}), solid);
  BothTracers both(CompiledScene::build(builder.finish()));
  Inputs inputs(9);
  uint64_t between = 0, different = 0;
  Comparison paths;
  for (uint64_t i = 0; i < rays; ++i) {
    const glm::vec3 from(inputs.uniform(-8.0f, -6.0f), inputs.uniform(-1.0f, 1.0f),
                         inputs.uniform(-1.0f, 1.0f)),
        to(inputs.uniform(1.0f, 8.0f), inputs.uniform(-1.0f, 1.0f), inputs.uniform(-1.0f, 1.0f));
    rl::Hit hit;
    const rl::Ray ray = rayFrom(from, to - from, 1.0f);
    const float a = both.embree->traceRay(ray, rl::RL_RAY_SHADOW, 0, hit),
                b = both.own.traceRay(ray, rl::RL_RAY_SHADOW, 0, hit);
    if (a > 0.0f && a < 1.0f) ++between;
    if (std::abs(a - b) > 1e-5f) ++different;
    compareRay(both, rayFrom(from, to - from), inputs.bits(), paths, hit);
  }
  EXPECT_GT(between, rays / 5);
  EXPECT_LT(double(different), 2e-4 * double(rays)) << "only rays through an edge";
  expectAgreement(paths, "sheets");
}

TEST(Bvh, RaysPassTransparentSheetsAlike) { compareTransparentSheets(100'000); }
TEST(BvhNightly, RaysPassTransparentSheetsAlike) { compareTransparentSheets(1'000'000); }

TEST(Bvh, EmptySceneIsMissed) {
  builtin::SceneBuilder builder("nothing");
  builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  BothTracers both(CompiledScene::build(builder.finish()));
  rl::Hit hit;
  EXPECT_EQ(both.own.traceRay(rayFrom({0, 0, 0}, {0, 0, 1}), rl::RL_RAY_PATH, 0, hit), 1.0f);
  EXPECT_EQ(hit.instance, rl::RL_INVALID);
}

}  // namespace
}  // namespace restlab::unit
