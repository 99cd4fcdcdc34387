// The project's own hierarchy against Embree, ray by ray, and its watertightness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/bvh_context.h"
#include "tests/unit/random_inputs.h"
#include "tests/unit/ray_cases.h"
#include "tests/varied_scenes.h"

namespace restlab::unit {
namespace {

// One scene with both tracers.
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

void compareRay(BothTracers& both, const rl::Ray& ray, uint32_t key, RayAgreement& sum,
                rl::Hit& hit) {
  rl::Hit own;
  both.embree->traceRay(ray, rl::RL_RAY_PATH, key, hit);
  both.own.traceRay(ray, rl::RL_RAY_PATH, key, own);
  sum.add(ray, hit, own);
}

// Camera-like rays from inside the scene's bounds, each followed along a random walk.
RayAgreement compareScene(const std::shared_ptr<const CompiledScene>& scene, uint64_t rays) {
  BothTracers both(scene);
  Inputs inputs(7);
  const auto [low, high] = startBounds(*scene);
  RayAgreement c;
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

void expectAgreement(const RayAgreement& c, const std::string& name) {
  std::printf("%s: %s\n", name.c_str(), c.text().c_str());
  EXPECT_EQ(c.unexplained, 0u) << name << ": " << c.first;
  EXPECT_EQ(c.grazing + c.starts, 0u) << name << ": these rays leave surfaces by the error bound";
  EXPECT_GT(c.hits, c.rays / 10) << name;
  EXPECT_LT(c.explainedShare(), 1e-2) << name;
}

TEST(Bvh, AgreesWithEmbreeOnBuiltinScenes) {
  for (const std::string& name : test::variedScenes()) {
    expectAgreement(compareScene(CompiledScene::build(makeBuiltinScene(name)), 50'000), name);
  }
}

TEST(BvhNightly, AgreesWithEmbreeOnBuiltinScenes) {
  for (const std::string& name : test::variedScenes()) {
    expectAgreement(compareScene(CompiledScene::build(makeBuiltinScene(name)), 1'000'000), name);
  }
}

// Stretched, mirrored and rotated instances of one mesh, inside each other.
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

// Rays from inside a closed mesh to its corners and edges: none may get out.
TEST(Bvh, ClosedMeshesAreWatertight) {
  for (const double distance : {0.0, 1e3}) {
    const ClosedBall ball(distance * glm::dvec3(0.6, -0.64, 0.48));
    BothTracers both(ball.scene);
    const std::vector<rl::Ray> rays = ball.raysAtEdges(400'000, 5);
    uint64_t leaks = 0;
    for (const rl::Ray& ray : rays) {
      rl::Hit hit;
      both.own.traceRay(ray, rl::RL_RAY_PATH, 0, hit);
      if (hit.instance != 0u) ++leaks;
    }
    EXPECT_EQ(leaks, 0u) << "of " << rays.size() << " at distance " << distance;
  }
}

// Both tracers must multiply the same transmittances for any-hit rays, and let closest-hit rays
// pass at the same surfaces.
void compareTransparentSheets(uint64_t rays) {
  const auto scene = veils();
  BothTracers both(scene);
  Inputs inputs(9);
  uint64_t between = 0, different = 0;
  RayAgreement paths;
  for (uint64_t i = 0; i < rays; ++i) {
    rl::Ray ray = rayThroughVeils(*scene, inputs);
    rl::Hit hit;
    const float a = both.embree->traceRay(ray, rl::RL_RAY_SHADOW, 0, hit),
                b = both.own.traceRay(ray, rl::RL_RAY_SHADOW, 0, hit);
    if (a > 0.0f && a < 1.0f) ++between;
    if (std::abs(a - b) > 1e-5f) ++different;
    ray.tMax = 3e38f;
    compareRay(both, ray, inputs.bits(), paths, hit);
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
