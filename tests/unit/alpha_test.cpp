// Partly transparent surfaces: path rays decide by chance, shadow rays multiply, and an emitter of
// coverage alpha gives as much light to light sampling as rays find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/bvh_context.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

rl::Material veil(float alpha) {
  rl::Material m = builtin::lambert(glm::vec3(0.5f));
  m.alpha = alpha;
  m.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  return m;
}

// Three veils and a wall behind them, all across the z axis.
std::shared_ptr<const CompiledScene> veilsInFrontOfALamp() {
  builtin::SceneBuilder builder("veils");
  const float alphas[4] = {0.5f, 0.2f, 0.9f, 1.0f};
  for (int i = 0; i < 4; ++i) {
    builder.add(
        builtin::quad("veil", {-1.1, -1.3, -double(i)}, {2, 0, 0}, {0, 2, 0}),
        builder.addMaterial("veil", i < 3 ? veil(alphas[i]) : builtin::lambert(glm::vec3(0.5f))));
  }
  return CompiledScene::build(builder.finish());
}

// Ray along -z from in front of the first veil to `length` metres behind it.
rl::Ray along(const Dialect<>& d, float length) {
  rl::Ray ray;
  ray.origin = glm::vec3(glm::dvec3(0, 0, 0.5) - d.compiledScene->origin());
  ray.dir = glm::vec3(0, 0, -1);
  ray.tMin = 0.0f;
  ray.tMax = 0.5f + length;
  return ray;
}

TEST(Alpha, ShadowRaysMultiplyTransmittance) {
  Dialect<> d(veilsInFrontOfALamp());
  rl::Hit hit;
  EXPECT_FLOAT_EQ(d->traceRay(along(d, -0.25f), rl::RL_RAY_SHADOW, 0, hit), 1.0f);
  EXPECT_FLOAT_EQ(d->traceRay(along(d, 0.5f), rl::RL_RAY_SHADOW, 0, hit), 0.5f);
  EXPECT_FLOAT_EQ(d->traceRay(along(d, 1.5f), rl::RL_RAY_SHADOW, 0, hit), 0.5f * 0.8f);
  EXPECT_FLOAT_EQ(d->traceRay(along(d, 2.5f), rl::RL_RAY_SHADOW, 0, hit), 0.5f * 0.8f * 0.1f);
  EXPECT_EQ(d->traceRay(along(d, 3.5f), rl::RL_RAY_SHADOW, 0, hit), 0.0f);
}

// Over many keys each veil stops its fraction of the path rays, independently of the others.
TEST(Alpha, PathRaysStopByChance) {
  Dialect<> d(veilsInFrontOfALamp());
  const std::vector<double> expected = {0.5, 0.5 * 0.2, 0.5 * 0.8 * 0.9, 0.5 * 0.8 * 0.1};
  std::vector<uint64_t> counts(4);
  constexpr uint64_t n = 1'000'000;
  for (uint32_t key = 0; key < n; ++key) {
    rl::Hit hit;
    d->traceRay(along(d, 1e3f), rl::RL_RAY_PATH, key * 0x632be59bu, hit);
    ASSERT_LT(hit.instance, 4u);
    ++counts[hit.instance];
  }
  expectFits(counts, expected, n, "veils");
}

// Equal keys give equal decisions, wherever the ray starts.
TEST(Alpha, DecisionBelongsToKeyAndPrimitive) {
  Dialect<> d(veilsInFrontOfALamp());
  for (uint32_t key = 0; key < 1000; ++key) {
    rl::Hit a{}, b{};
    d->traceRay(along(d, 1e3f), rl::RL_RAY_PATH, key, a);
    rl::Ray later = along(d, 1e3f);
    later.tMin = 0.25f;
    d->traceRay(later, rl::RL_RAY_PATH, key, b);
    EXPECT_EQ(a.instance, b.instance);
    EXPECT_EQ(a.primitive, b.primitive);
  }
}

// A square of two triangles and a fan of six, both half transparent: rays through the shared edge
// and through the shared corner meet one surface, with every tracer.
template <typename Trace>
void expectOneSurfaceAtEdges(const char* what, const Trace& trace) {
  struct Place {
    const char* name;
    glm::dvec2 at;
  };
  for (const Place& place : {Place{"inside", {0.3, 0.1}}, Place{"edge", {0.25, 0.25}},
                             Place{"corner", {10.0, 0.0}}, Place{"edge of the fan", {10.5, 0.0}}}) {
    EXPECT_FLOAT_EQ(trace(place.at, rl::RL_RAY_SHADOW, 0u), 0.5f) << what << ", " << place.name;
    int stopped = 0;
    constexpr int n = 20'000;
    for (uint32_t key = 0; key < n; ++key)
      stopped += trace(place.at, rl::RL_RAY_PATH, key * 0x632be59bu) > 0.0f ? 1 : 0;
    EXPECT_NEAR(stopped / double(n), 0.5, 0.02) << what << ", " << place.name;
  }
}

TEST(Alpha, IsAskedOnceWhereTrianglesMeet) {
  builtin::SceneBuilder builder("shared");
  const uint32_t half = builder.addMaterial("veil", veil(0.5f));
  builder.add(builtin::quad("square", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), half);
  MeshGeometry fan;
  fan.name = "fan";
  fan.positions = {{10, 0, 0}};
  for (int i = 0; i < 6; ++i) {
    // Corners of a hexagon, two of them on the x axis.
    const double angle = i * 3.14159265358979323846 / 3.0;
    fan.positions.emplace_back(10.0 + std::cos(angle), i % 3 == 0 ? 0.0 : std::sin(angle), 0.0);
    // Each triangle has a centre vertex of its own: only the position is shared.
    fan.positions.emplace_back(10, 0, 0);
  }
  for (uint32_t i = 0; i < 6; ++i)
    fan.triangles.push_back({2u * i + 2u, 2u * i + 1u, 2u * ((i + 1u) % 6u) + 1u});
  builder.add(fan, half);
  Dialect<> d(CompiledScene::build(builder.finish()));
  d.compiledScene->bindBvh();
  const rl::SceneData withBvh = d.compiledScene->data();
  rl::BvhCtx bvh{withBvh, d.frame, d.counters};
  const auto rayAt = [&](const glm::dvec2& at) {
    rl::Ray ray;
    ray.origin = glm::vec3(glm::dvec3(at, 1.0) - d.compiledScene->origin());
    ray.dir = glm::vec3(0, 0, -1);
    ray.tMin = 0.0f;
    ray.tMax = 2.0f;
    return ray;
  };
  // Transmittance of shadow rays; for path rays 1 if they stop, else 0.
  const auto with = [&](auto& context) {
    return [&](const glm::dvec2& at, uint32_t mode, uint32_t key) {
      rl::Hit hit;
      const float passed = context.traceRay(rayAt(at), mode, key, hit);
      if (mode == rl::RL_RAY_SHADOW) return passed;
      return hit.instance != rl::RL_INVALID ? 1.0f : 0.0f;
    };
  };
  expectOneSurfaceAtEdges("Embree", with(d.ctx));
  expectOneSurfaceAtEdges("own hierarchy", with(bvh));
}

// Irradiance from an emitter whose coverage varies over it, by light sampling and by rays.
TEST(Alpha, EmittersGiveWhatRaysFind) {
  builtin::SceneBuilder builder("veiled lamp");
  rl::Material lamp = builtin::lamp(glm::vec3(5.0f));
  lamp.alpha = 0.6f;
  lamp.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  MeshGeometry mesh = builtin::quad("lamp", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  mesh.colors.assign(mesh.positions.size(), glm::vec4(1.0f));
  mesh.colors[0].w = 0.1f;
  mesh.colors[2].w = 0.3f;
  builder.add(mesh, builder.addMaterial("lamp", lamp));
  Dialect<> d(CompiledScene::build(builder.finish()));
  ASSERT_NE(d.compiledScene->features() & rl::RL_FEATURE_ALPHA, 0u);
  const glm::vec3 at(0.2f, -0.3f, 1.0f);
  Inputs inputs(1);
  constexpr uint32_t n = 400'000;
  double byLight = 0.0, byRays = 0.0, squares = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    const rl::Rng rng = d->rngInit(4, i, 0);
    const rl::LightSample s = d->lightSample(rng, anyReceiver());
    const rl::LightConnection c = d->lightConnect(s, at);
    byLight += double(c.emitted.x) * c.geometry * std::max(-c.dirW.z, 0.0f) / s.pdf / n;
    rl::Ray ray;
    ray.origin = at;
    ray.tMin = 0.0f;
    ray.tMax = 3e38f;
    ray.dir = d->warpCosineHemisphere(inputs.square());
    ray.dir.z = -ray.dir.z;
    rl::Hit hit;
    d->traceRay(ray, rl::RL_RAY_PATH, inputs.bits(), hit);
    if (hit.instance == rl::RL_INVALID) continue;
    const double x = d->surfaceLoad(hit, ray.dir).emission.x * 3.14159265358979;
    byRays += x / n;
    squares += x * x / n;
  }
  const double error = std::sqrt((squares - byRays * byRays) / n);
  EXPECT_NEAR(byLight, byRays, 5.0 * error);
  EXPECT_LT(byLight, 0.7 * 5.0 * 3.14159);
}

}  // namespace
}  // namespace restlab::unit
