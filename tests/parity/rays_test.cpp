// Rays of a Vulkan device, by the project's own hierarchy and by ray queries, against Embree's: ray
// by ray, along edges, and through partly transparent surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/backend/vulkan_device.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/rays.h"
#include "tests/unit/random_inputs.h"
#include "tests/unit/ray_cases.h"

namespace restlab::parity {
namespace {

using Compiled = std::shared_ptr<const CompiledScene>;

constexpr const char* kNoQuery = "SKIPPED: no Vulkan device with ray queries";

bool hasRayQuery() {
  const std::vector<VulkanDeviceInfo> devices = vulkanDeviceInfos();
  return !devices.empty() && devices[0].whyNot.empty() && devices[0].hasRayQuery;
}

void compare(const std::vector<rl::TraceQuery>& queries, const std::vector<rl::TraceResult>& embree,
             const std::vector<rl::TraceResult>& device, unit::RayAgreement& sum) {
  for (size_t i = 0; i < queries.size(); ++i) sum.add(queries[i].ray, embree[i].hit, device[i].hit);
}

// Compares `count` rays in all directions, and as many that start near their hits.
void expectEmbreesHits(const std::string& sceneName, const std::string& rayTracing, size_t count) {
  const Compiled scene = sceneNamed(sceneName);
  RayTracer embree(scene, "cpu", "embree"), device(scene, "vulkan", rayTracing);
  std::vector<rl::TraceQuery> queries = randomQueries(scene, count, 17);
  const std::vector<rl::TraceResult> found = embree.trace(queries);
  unit::RayAgreement sum;
  compare(queries, found, device.trace(queries), sum);
  unit::Inputs inputs(18);
  for (size_t i = 0; i < count; ++i) {
    if (found[i].hit.instance == rl::RL_INVALID) continue;
    rl::Ray& ray = queries[i].ray;
    // Start a thousandth before the surface, so that no tracer decides about the surface itself.
    ray.origin += ray.dir * (0.999f * found[i].hit.t);
    ray.dir = inputs.direction();
  }
  compare(queries, embree.trace(queries), device.trace(queries), sum);
  std::printf("  %s, %s: %s\n", sceneName.c_str(), rayTracing.c_str(), sum.text().c_str());
  EXPECT_EQ(sum.unexplained, 0u) << sceneName << ": " << sum.first;
  EXPECT_GT(sum.hits, sum.rays / 10) << sceneName;
  EXPECT_LT(sum.explainedShare(), 1e-2) << sceneName;
}

// Rays from inside a closed mesh to its corners and edges: none may get out.
void expectWatertight(const std::string& rayTracing) {
  const unit::ClosedBall ball(glm::dvec3(0.0));
  std::vector<rl::TraceQuery> queries;
  for (const rl::Ray& ray : ball.raysAtEdges(200'000, 5))
    queries.push_back({ray, rl::RL_RAY_PATH, 0, 0, 0});
  size_t leaks = 0;
  for (const rl::TraceResult& result : RayTracer(ball.scene, "vulkan", rayTracing).trace(queries))
    leaks += result.hit.instance != 0u ? 1 : 0;
  std::printf("  %s: %zu of %zu rays at edges and corners pass\n", rayTracing.c_str(), leaks,
              queries.size());
  // Ray queries of Mesa 25's lavapipe are not watertight (0.5 % of these rays): a property of that
  // driver, bounded here and documented in docs/performance.md.
  const bool isDriversOwn = rayTracing == "query" && vulkanDeviceInfos()[0].kind == "cpu";
  EXPECT_LE(leaks, isDriversOwn ? queries.size() / 100 : 0u) << "of " << queries.size();
}

// Shadow rays through veils: the device must multiply the same transmittances as Embree's filters.
void expectSameTransmittance(const std::string& rayTracing) {
  const Compiled scene = unit::veils();
  unit::Inputs inputs(9);
  std::vector<rl::TraceQuery> queries;
  for (int i = 0; i < 100'000; ++i)
    queries.push_back({unit::rayThroughVeils(*scene, inputs), rl::RL_RAY_SHADOW, 0, 0, 0});
  const auto embree = RayTracer(scene, "cpu", "embree").trace(queries);
  const auto device = RayTracer(scene, "vulkan", rayTracing).trace(queries);
  size_t between = 0, blocked = 0, different = 0;
  for (size_t i = 0; i < queries.size(); ++i) {
    const float t = embree[i].transmittance;
    between += t > 0.0f && t < 1.0f ? 1 : 0;
    blocked += t == 0.0f ? 1 : 0;
    different += std::abs(t - device[i].transmittance) > 1e-5f ? 1 : 0;
  }
  EXPECT_GT(between, queries.size() / 5);
  EXPECT_GT(blocked, queries.size() / 100);
  EXPECT_LT(double(different), 2e-4 * double(queries.size())) << "only rays through an edge";
}

TEST(Rays, HitWhatEmbreesHit) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const std::string& scene : sceneNames()) expectEmbreesHits(scene, "bvh", 500'000);
}
TEST(Rays, StayInClosedMeshes) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  expectWatertight("bvh");
}
TEST(Rays, PassVeilsAlike) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  expectSameTransmittance("bvh");
}

TEST(RayQueryRays, HitWhatEmbreesHit) {
  if (!hasRayQuery()) GTEST_SKIP() << kNoQuery;
  for (const std::string& scene : sceneNames()) expectEmbreesHits(scene, "query", 10'000);
}
TEST(RayQueryRays, StayInClosedMeshes) {
  if (!hasRayQuery()) GTEST_SKIP() << kNoQuery;
  expectWatertight("query");
}
TEST(RayQueryRays, PassVeilsAlike) {
  if (!hasRayQuery()) GTEST_SKIP() << kNoQuery;
  expectSameTransmittance("query");
}

}  // namespace
}  // namespace restlab::parity
