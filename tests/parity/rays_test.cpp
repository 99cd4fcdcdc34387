// Rays of a Vulkan device, by the project's own hierarchy and by ray queries, against Embree's: ray
// by ray, along edges, and through surfaces that let light pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/backend/vulkan_device.h"
#include "core/scene/builtin_builder.h"
#include "core/scene/builtin_mesh.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/rays.h"
#include "tests/unit/random_inputs.h"

namespace restlab::parity {
namespace {

using Compiled = std::shared_ptr<const CompiledScene>;

constexpr const char* kNoQuery = "SKIPPED: no Vulkan device with ray queries";

bool hasRayQuery() {
  const std::vector<VulkanDeviceInfo> devices = vulkanDeviceInfos();
  return !devices.empty() && devices[0].whyNot.empty() && devices[0].hasRayQuery;
}

// Within 1e-4 of an edge, as a share of the triangle.
bool isNearEdge(const rl::Hit& hit) {
  if (hit.instance == rl::RL_INVALID) return false;
  return std::min({hit.bary.x, hit.bary.y, 1.0f - hit.bary.x - hit.bary.y}) < 1e-4f;
}

struct Agreement {
  uint64_t rays = 0, hits = 0, ties = 0, edges = 0, unexplained = 0;
  uint64_t grazing = 0;  // the same triangle, almost along its plane: t is ill-conditioned
  uint64_t starts = 0;   // on a surface, to rounding: only one of the two has hit it
  std::string first;     // that is not explained
};

void compare(const std::vector<rl::TraceQuery>& queries, const std::vector<rl::TraceResult>& embree,
             const std::vector<rl::TraceResult>& device, Agreement& sum) {
  for (size_t i = 0; i < queries.size(); ++i) {
    const rl::Hit &a = embree[i].hit, &b = device[i].hit;
    const bool hitsA = a.instance != rl::RL_INVALID, hitsB = b.instance != rl::RL_INVALID;
    // Distances are rounded at the size of the coordinates.
    const glm::vec3 o = glm::abs(queries[i].ray.origin);
    const float atOrigin = 2e-5f * std::max({o.x, o.y, o.z});
    const float tolerance = 1e-4f * a.t + atOrigin;
    const bool isAsFar = hitsA && hitsB && std::abs(a.t - b.t) <= tolerance;
    const bool isSame = a.instance == b.instance && (!hitsA || a.primitive == b.primitive);
    ++sum.rays;
    sum.hits += hitsA ? 1 : 0;
    if (isSame && (!hitsA || isAsFar)) continue;
    if (isAsFar) {
      ++sum.ties;
    } else if (isSame && std::abs(a.t - b.t) <= 1e-2f * a.t) {
      ++sum.grazing;
    } else if ((hitsA && a.t <= atOrigin) || (hitsB && b.t <= atOrigin)) {
      ++sum.starts;
    } else if (isNearEdge(a) || isNearEdge(b)) {
      ++sum.edges;
    } else if (sum.unexplained++ == 0) {
      char text[200];
      std::snprintf(text, sizeof text, "ray %zu: Embree %d %d t %g, device %d %d t %g", i,
                    int(a.instance), int(a.primitive), a.t, int(b.instance), int(b.primitive), b.t);
      sum.first = text;
    }
  }
}

// `count` rays in all directions, and as many that leave what the first ones have hit.
void expectEmbreesHits(const std::string& sceneName, const std::string& rayTracing, size_t count) {
  const Compiled scene = sceneNamed(sceneName);
  RayTracer embree(scene, "cpu", "embree"), device(scene, "vulkan", rayTracing);
  std::vector<rl::TraceQuery> queries = randomQueries(scene, count, 17);
  const std::vector<rl::TraceResult> found = embree.trace(queries);
  Agreement sum;
  compare(queries, found, device.trace(queries), sum);
  unit::Inputs inputs(18);
  for (size_t i = 0; i < count; ++i) {
    if (found[i].hit.instance == rl::RL_INVALID) continue;
    rl::Ray& ray = queries[i].ray;
    // A thousandth before the surface: neither tracer is asked about the surface itself.
    ray.origin += ray.dir * (0.999f * found[i].hit.t);
    ray.dir = inputs.direction();
  }
  compare(queries, embree.trace(queries), device.trace(queries), sum);
  std::printf(
      "  %s, %s: %llu rays, %llu hits, %llu ties, %llu at edges, %llu at their start, %llu "
      "grazing, "
      "%llu unexplained\n",
      sceneName.c_str(), rayTracing.c_str(), static_cast<unsigned long long>(sum.rays),
      static_cast<unsigned long long>(sum.hits), static_cast<unsigned long long>(sum.ties),
      static_cast<unsigned long long>(sum.edges), static_cast<unsigned long long>(sum.starts),
      static_cast<unsigned long long>(sum.grazing),
      static_cast<unsigned long long>(sum.unexplained));
  EXPECT_EQ(sum.unexplained, 0u) << sceneName << ": " << sum.first;
  EXPECT_GT(sum.hits, sum.rays / 10) << sceneName;
  EXPECT_LT(double(sum.ties + sum.edges + sum.starts + sum.grazing), 1e-2 * double(sum.rays))
      << sceneName;
}

// From inside a closed mesh, at its corners and along its edges: none gets out.
void expectWatertight(const std::string& rayTracing) {
  builtin::SceneBuilder builder("closed");
  const uint32_t id = builder.addMaterial("grey", builtin::lambert(glm::vec3(0.5f)));
  const MeshGeometry mesh = builtin::sphere("ball", {0, 0, 0}, 1.0, 5, true);
  builder.add(mesh, id);
  const Compiled scene = CompiledScene::build(builder.finish());
  unit::Inputs inputs(5);
  std::vector<rl::TraceQuery> queries(200'000);
  for (size_t i = 0; i < queries.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[inputs.below(uint32_t(mesh.triangles.size()))];
    const float u = i % 4 == 0 ? 0.0f : inputs.uniform();  // a corner, or a place on an edge
    const glm::vec3 target = mesh.positions[t.x] + u * (mesh.positions[t.y] - mesh.positions[t.x]);
    const glm::vec3 from = 0.5f * inputs.uniform() * inputs.direction();
    queries[i].ray = {from - glm::vec3(scene->origin()), 0.0f, target - from, 3e38f};
  }
  size_t leaks = 0;
  for (const rl::TraceResult& result : RayTracer(scene, "vulkan", rayTracing).trace(queries))
    leaks += result.hit.instance != 0u ? 1 : 0;
  std::printf("  %s: %zu of %zu rays at edges and corners pass\n", rayTracing.c_str(), leaks,
              queries.size());
  // The ray queries of Mesa 25's lavapipe are not watertight (0.5 % of these rays): a property of
  // that driver, which is bounded here and written down in docs/performance.md.
  const bool isDriversOwn = rayTracing == "query" && vulkanDeviceInfos()[0].kind == "cpu";
  EXPECT_LE(leaks, isDriversOwn ? queries.size() / 100 : 0u) << "of " << queries.size();
}

// Shadow rays through veils: what Embree's filters multiply, the device multiplies.
void expectSameTransmittance(const std::string& rayTracing) {
  builtin::SceneBuilder builder("veils");
  rl::Material veil = builtin::lambert(glm::vec3(0.5f));
  veil.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  veil.alpha = 0.25f;
  const uint32_t id = builder.addMaterial("veil", veil),
                 solid = builder.addMaterial("solid", builtin::lambert(glm::vec3(0.5f)));
  const uint32_t mesh = builder.addGeometry(builtin::sphere("ball", {0, 0, 0}, 1.0, 2, false));
  for (const double x : {0.0, 3.0}) {
    glm::dmat4 place(1.0);
    place[3] = {x, 0, 0, 1};
    builder.place("ball", mesh, id, place);
  }
  builder.add(builtin::sphere("own", {6, 0, 0}, 1.0, 2, false), id);
  builder.add(builtin::box("block", {8, -1, -1}, {9, 1, 1}), solid);
  const Compiled scene = CompiledScene::build(builder.finish());
  const glm::vec3 origin(scene->origin());
  unit::Inputs inputs(9);
  std::vector<rl::TraceQuery> queries(100'000);
  for (rl::TraceQuery& q : queries) {
    glm::vec3 from, to;
    from.x = inputs.uniform(-8.0f, -6.0f);
    to.x = inputs.uniform(1.0f, 10.0f);
    from.y = inputs.uniform(-1.0f, 1.0f);
    to.y = inputs.uniform(-1.0f, 1.0f);
    from.z = inputs.uniform(-1.0f, 1.0f);
    to.z = inputs.uniform(-1.0f, 1.0f);
    q.ray = {from - origin, 0.0f, to - from, 1.0f};
    q.mode = rl::RL_RAY_SHADOW;
  }
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
