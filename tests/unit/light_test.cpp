// The light table and its sampling: selection by kind and power, points on triangles, densities of
// light sampling and of ray hits, punctual lights, MIS weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

double luminance(const glm::dvec3& c) { return 0.212639 * c.x + 0.715169 * c.y + 0.072192 * c.z; }

MeshGeometry triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  MeshGeometry mesh;
  mesh.name = "triangle";
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

rl::Rng rngOf(Dialect<>& d, uint32_t sample) {
  rl::Rng rng = d->rngInit(1, sample & 0xffffu, sample >> 16);
  rng.vertex = 1;
  return rng;
}

// 10,000 triangles whose powers span nine decades; some emit on both sides, some are black.
TEST(LightSelection, TenThousandLightsByPower) {
  builtin::SceneBuilder builder("many");
  Inputs inputs(1);
  std::vector<double> power;
  std::vector<uint32_t> materials;
  std::vector<glm::vec3> radiance;
  std::vector<bool> twoSided;
  for (int m = 0; m < 20; ++m) {
    radiance.push_back(
        glm::vec3(inputs.scale(1e-3f, 1e3f), inputs.scale(1e-3f, 1e3f), inputs.scale(1e-3f, 1e3f)));
    rl::Material lamp = builtin::lamp(radiance.back());
    twoSided.push_back(m % 3 == 0);
    if (twoSided.back()) lamp.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    materials.push_back(builder.addMaterial("lamp", lamp));
  }
  for (int i = 0; i < 10'000; ++i) {
    const glm::vec3 p(inputs.uniform(-5, 5), inputs.uniform(-5, 5), inputs.uniform(-5, 5));
    const float size = inputs.scale(0.01f, 1.0f);
    const glm::vec3 e1 = size * inputs.direction(), e2 = size * inputs.direction();
    const uint32_t m = inputs.below(20);
    builder.add(triangle(p, p + e1, p + e2), materials[m]);
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(e1), glm::dvec3(e2)));
    power.push_back(area * luminance(glm::dvec3(radiance[m])) * (twoSided[m] ? 2.0 : 1.0));
  }
  Dialect<> d(CompiledScene::build(builder.finish()));
  ASSERT_EQ(d.scene.lightCount, 10'000u);
  const double total = std::accumulate(power.begin(), power.end(), 0.0);
  double sum = 0.0;
  for (size_t i = 0; i < power.size(); ++i) {
    power[i] /= total;
    sum += d.scene.lights.data[i].pmf;
    // The threshold of a column is a multiple of 2^-32.
    const double rounding = 1.0 / (power[i] * double(power.size()) * 0x1p32);
    ASSERT_NEAR(d.scene.lights.data[i].pmf / power[i], 1.0, 1e-3 + rounding) << i;
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
  constexpr uint32_t n = 4'000'000;
  std::vector<uint64_t> counts(power.size());
  for (uint32_t i = 0; i < n; ++i) ++counts[d->lightSelect(rngOf(d, i))];
  expectFits(counts, power, n, "light selection");
}

// Lamps share by power, and so do suns; lamps, suns and sky each get a third, whatever the size of
// the scene.
TEST(LightSelection, KindsShareEvenlyWhateverTheSize) {
  for (const float ground : {1.0f, 1e7f}) {
    builtin::SceneBuilder builder("kinds");
    builder.add(triangle({-ground, -1, -ground}, {-ground, -1, ground}, {ground, -1, 0}),
                builder.addMaterial("ground", builtin::lambert(glm::vec3(0.5f))));
    builder.add(triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}),
                builder.addMaterial("lamp", builtin::lamp(glm::vec3(3.0f))));
    PunctualLight point;
    point.intensity = glm::vec3(5.0f);
    builder.addLight(point);
    PunctualLight spot;
    spot.kind = rl::RL_LIGHT_SPOT;
    spot.intensity = glm::vec3(7.0f);
    spot.outerConeAngle = 0.5f;
    builder.addLight(spot);
    PunctualLight sun;
    sun.kind = rl::RL_LIGHT_DIRECTIONAL;
    for (const float irradiance : {2.0f, 6e-4f}) {
      sun.intensity = glm::vec3(irradiance);
      builder.addLight(sun);
    }
    EnvironmentMap map;
    map.width = 8;
    map.height = 4;
    map.radiance.assign(32, glm::vec3(0.01f));
    map.radiance[9] = glm::vec3(400.0f);
    builder.setEnvironment(map);
    Dialect<> d(CompiledScene::build(builder.finish()));
    ASSERT_EQ(d.scene.lightCount, 6u);
    ASSERT_EQ(d.scene.environmentLight, 5u);
    const double watts[3] = {kPi * 2.0 * 3.0, 4.0 * kPi * 5.0,
                             2.0 * kPi * (1.0 - std::cos(0.5)) * 7.0};
    std::vector<double> expected;
    for (const double w : watts) expected.push_back(w / (watts[0] + watts[1] + watts[2]) / 3.0);
    for (const double w : {2.0, 6e-4}) expected.push_back(w / 2.0006 / 3.0);
    expected.push_back(1.0 / 3.0);
    for (uint32_t i = 0; i < 6; ++i)
      EXPECT_NEAR(d.scene.lights.data[i].pmf / expected[i], 1.0, 1e-5) << i;
    std::vector<uint64_t> counts(6);
    for (uint32_t i = 0; i < 1'000'000; ++i) ++counts[d->lightSelect(rngOf(d, i))];
    expectFits(counts, expected, 1'000'000, "kinds of lights");
  }
}

// Powers over 12 decades: each lamp is drawn with the probability of its pmf, found from the
// threshold of each column. With 24 random bits, lamps rarer than 2^-24 would be drawn too often.
TEST(LightSelection, WhatIsRareIsDrawnAsOftenAsItsPmfSays) {
  builtin::SceneBuilder builder("rare");
  constexpr uint32_t n = 13;
  for (uint32_t i = 0; i < n; ++i) {
    PunctualLight point;
    point.intensity = glm::vec3(std::pow(10.0f, -float(i)));
    builder.addLight(point);
  }
  builder.add(triangle({-1, 0, -1}, {1, 0, -1}, {0, 0, 1}),
              builder.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  Dialect<> d(CompiledScene::build(builder.finish()));
  ASSERT_EQ(d.scene.lightCount, n);
  std::vector<double> drawn(n);
  for (uint32_t column = 0; column < n; ++column) {
    const uint64_t first = ((uint64_t(column) << 32u) + n - 1u) / n,
                   end = ((uint64_t(column + 1u) << 32u) + n - 1u) / n;
    const auto at = [&](uint64_t aliasBits) {
      return d->lightAt(uint32_t(first + (end - first) / 2u), uint32_t(aliasBits));
    };
    // Find the first aliasBits that give another light than 0 does; 2^32 if there are none.
    uint64_t low = 0, high = uint64_t(1) << 32u;
    while (low + 1u < high) {
      const uint64_t middle = (low + high) / 2u;
      (at(middle) == at(0) ? low : high) = middle;
    }
    const double share = double(end - first) / 0x1p32;
    drawn[at(0)] += share * double(high) / 0x1p32;
    drawn[at(0xffffffffu)] += share * (1.0 - double(high) / 0x1p32);
  }
  for (uint32_t i = 0; i < n; ++i) {
    EXPECT_NEAR(drawn[i] / d.scene.lights.data[i].pmf, 1.0, 1e-6) << i;
    EXPECT_NEAR(d.scene.lights.data[i].pmf / std::pow(10.0, -double(i)) / (0.9), 1.0,
                i < 8 ? 0.02 : 100.0)
        << i;
  }
}

struct OneLamp {
  // A skew triangle far from the scene's origin; the wall keeps the scene's centre away from it.
  glm::dvec3 a{1.0, 2.0, 0.5}, b{1.8, 2.1, 0.4}, c{1.1, 2.9, 0.9};
  std::shared_ptr<const CompiledScene> scene;
  glm::dvec3 origin{0.0};

  explicit OneLamp(bool twoSided = false, const glm::dmat4* mirror = nullptr) {
    builtin::SceneBuilder builder("one lamp");
    rl::Material lamp = builtin::lamp(glm::vec3(2.0f, 1.0f, 0.5f));
    if (twoSided) lamp.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
    const uint32_t id = builder.addMaterial("lamp", lamp);
    const uint32_t mesh = builder.addGeometry(triangle(glm::vec3(a), glm::vec3(b), glm::vec3(c)));
    builder.place("lamp", mesh, id, mirror != nullptr ? *mirror : glm::dmat4(1.0));
    // A second use of the mesh makes both instances.
    if (mirror != nullptr) {
      builder.place("twin", mesh, builder.addMaterial("dark", builtin::lambert(glm::vec3(0.0f))),
                    glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 90, 0, 0, 1));
    }
    builder.add(triangle({-30, -30, -9}, {-29, -30, -9}, {-30, -29, -9}),
                builder.addMaterial("wall", builtin::lambert(glm::vec3(0.5f))));
    scene = CompiledScene::build(builder.finish());
    origin = scene->origin();
  }
};

TEST(LightDraw, TriangleIsUniformOverItsArea) {
  OneLamp lamp;
  Dialect<> d(lamp.scene);
  const glm::dvec3 a = lamp.a - lamp.origin, e1 = lamp.b - lamp.a, e2 = lamp.c - lamp.a;
  const glm::dvec3 normal = glm::normalize(glm::cross(e1, e2));
  const double area = 0.5 * glm::length(glm::cross(e1, e2));
  constexpr int n = 16;
  std::vector<uint64_t> counts(n * (n + 1) / 2);
  std::vector<double> probabilities(counts.size());
  constexpr uint32_t samples = 1'000'000;
  for (uint32_t i = 0; i < samples; ++i) {
    const rl::LightSample s = d->lightSample(rngOf(d, i), anyReceiver());
    ASSERT_NEAR(s.pdf * area, 1.0, 1e-4);
    // Compute barycentric coordinates by projection.
    const glm::dvec3 v = glm::dvec3(s.point) - a;
    ASSERT_LT(std::abs(glm::dot(v, normal)), 1e-5);
    const double d11 = glm::dot(e1, e1), d12 = glm::dot(e1, e2), d22 = glm::dot(e2, e2);
    const double det = d11 * d22 - d12 * d12;
    const double x = (d22 * glm::dot(v, e1) - d12 * glm::dot(v, e2)) / det;
    const double y = (d11 * glm::dot(v, e2) - d12 * glm::dot(v, e1)) / det;
    ASSERT_GT(std::min(x, y), -1e-5);
    ASSERT_LT(x + y, 1.0 + 1e-5);
    const int ix = std::clamp(int(x * n), 0, n - 1), iy = std::clamp(int(y * n), 0, n - 1 - ix);
    ++counts[size_t(ix * n - ix * (ix - 1) / 2 + iy)];
    if (i == 0) {
      EXPECT_LT(glm::distance(glm::dvec3(s.normal), normal), 1e-5);
      EXPECT_EQ(s.radiance, glm::vec3(2.0f, 1.0f, 0.5f));
    }
  }
  // Cells: squares of the barycentric grid, and triangles along its diagonal.
  size_t k = 0;
  for (int ix = 0; ix < n; ++ix) {
    for (int iy = 0; iy < n - ix; ++iy)
      probabilities[k++] = (ix + iy == n - 1 ? 1.0 : 2.0) / (n * n);
  }
  expectFits(counts, probabilities, samples, "points on a triangle");
}

// Solid angle of a small triangle, exactly (Van Oosterom & Strackee 1983).
double solidAngle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                  const glm::dvec3& c) {
  const glm::dvec3 x = glm::normalize(a - p), y = glm::normalize(b - p), z = glm::normalize(c - p);
  return 2.0 * std::abs(std::atan2(glm::dot(x, glm::cross(y, z)),
                                   1.0 + glm::dot(x, y) + glm::dot(y, z) + glm::dot(z, x)));
}

// Checks the density per solid angle, converted from density per area, against the solid angle of a
// patch around the point.
TEST(LightConnect, ConvertsAreaToSolidAngle) {
  for (const bool twoSided : {false, true}) {
    OneLamp lamp(twoSided);
    Dialect<> d(lamp.scene);
    const glm::dvec3 a = lamp.a - lamp.origin, e1 = lamp.b - lamp.a, e2 = lamp.c - lamp.a;
    const glm::dvec3 normal = glm::normalize(glm::cross(e1, e2));
    Inputs inputs(3);
    int front = 0, back = 0;
    for (uint32_t i = 0; i < 20'000; ++i) {
      const rl::LightSample s = d->lightSample(rngOf(d, i), anyReceiver());
      const glm::dvec3 at =
          a + 3.0 * double(inputs.uniform(0.2f, 1.0f)) * glm::dvec3(inputs.direction());
      const rl::LightConnection c = d->lightConnect(s, glm::vec3(at));
      const double side = glm::dot(at - glm::dvec3(s.point), normal);
      if (std::abs(side) < 0.02) continue;
      if (side < 0.0 && !twoSided) {
        ++back;
        ASSERT_EQ(c.emitted, glm::vec3(0.0f));
        ASSERT_EQ(c.pdfSolidAngle, 0.0f);
        continue;
      }
      ++front;
      constexpr double h = 1e-4;
      const glm::dvec3 p(s.point), u = h * glm::normalize(e1),
                                   v = h * glm::cross(normal, glm::normalize(e1));
      const glm::dvec3 seen{glm::vec3(at)};
      const double patch = solidAngle(seen, p - u - v, p + u - v, p + u + v) +
                           solidAngle(seen, p - u - v, p + u + v, p - u + v);
      ASSERT_NEAR(c.geometry / (patch / (4.0 * h * h)), 1.0, 2e-3);
      ASSERT_NEAR(c.pdfSolidAngle * c.geometry / s.pdf, 1.0, 1e-5);
      ASSERT_NEAR(c.distance, glm::distance(p, seen), 1e-5);
      ASSERT_FALSE(c.isDelta);
      ASSERT_EQ(c.emitted, s.radiance);
    }
    EXPECT_GT(front, 5000);
    EXPECT_EQ(back > 5000, !twoSided);
  }
}

// Light sampling and a ray that hits the same point agree on density, radiance and side.
void expectRaysAgree(OneLamp& lamp) {
  Dialect<> d(lamp.scene);
  Inputs inputs(4);
  int compared = 0, dark = 0;
  for (uint32_t i = 0; i < 20'000; ++i) {
    const rl::LightSample s = d->lightSample(rngOf(d, i), anyReceiver());
    const glm::vec3 at = s.point + inputs.uniform(0.2f, 3.0f) * inputs.direction();
    const rl::LightConnection c = d->lightConnect(s, at);
    rl::Ray ray;
    ray.origin = at;
    ray.tMin = 0.0f;
    ray.dir = c.dirW;
    ray.tMax = 3e38f;
    rl::Hit hit;
    d->traceRay(ray, rl::RL_RAY_PATH, 0, hit);
    if (hit.instance == rl::RL_INVALID) continue;  // past an edge by rounding
    const rl::Surface surface = d->surfaceLoad(hit, ray.dir);
    ASSERT_EQ(surface.light != rl::RL_INVALID, true);
    if (std::abs(glm::dot(s.normal, c.dirW)) < 0.02f) continue;
    ASSERT_EQ(surface.emission, c.emitted);
    if (c.emitted == glm::vec3(0.0f)) {
      ++dark;
      continue;
    }
    ++compared;
    const float pdf =
        d->lightPdfOfHit(surface.light, surface.id, anyReceiver(), surface.nGeoW, ray.dir, hit.t);
    ASSERT_NEAR(pdf / c.pdfSolidAngle, 1.0f, 2e-3f);
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(compared + dark, 15'000);
}

TEST(LightDraw, DensityIsThatOfTheHit) {
  OneLamp oneSided, twoSided(true);
  expectRaysAgree(oneSided);
  expectRaysAgree(twoSided);
  const glm::dmat4 mirror(-1.5, 0, 0, 0, 0, 0.7, 0, 0, 0.2, 0, 1, 0, 4, 1, 2, 1);
  OneLamp mirrored(false, &mirror);
  expectRaysAgree(mirrored);
}

TEST(Punctual, PointAndSpotAndSun) {
  Dialect<> d;
  rl::LightSample s{};
  s.pdf = 0.25f;
  s.radiance = glm::vec3(8.0f);
  s.kind = rl::RL_LIGHT_POINT;
  s.point = glm::vec3(0.0f, 0.0f, 2.0f);
  s.normal = glm::vec3(0.0f, 0.0f, 1.0f);  // 1 / r^2
  rl::LightConnection c = d->lightConnect(s, glm::vec3(0.0f));
  EXPECT_EQ(c.dirW, glm::vec3(0.0f, 0.0f, 1.0f));
  EXPECT_FLOAT_EQ(c.distance, 2.0f);
  EXPECT_FLOAT_EQ(c.emitted.x, 2.0f);  // W/sr over m^2
  EXPECT_TRUE(c.isDelta);
  EXPECT_EQ(c.pdfSolidAngle, 0.0f);
  s.normal = glm::vec3(1.0f, 0.5f, 0.5f);
  EXPECT_FLOAT_EQ(d->lightConnect(s, glm::vec3(0.0f)).emitted.x, 2.0f) << "1 + 0.5 r + 0.5 r^2";

  s.kind = rl::RL_LIGHT_DIRECTIONAL;
  s.point = glm::vec3(0.0f, 1.0f, 0.0f);
  c = d->lightConnect(s, glm::vec3(5.0f, -3.0f, 1.0f));
  EXPECT_EQ(c.dirW, s.point);
  EXPECT_EQ(c.distance, 0.0f);
  EXPECT_EQ(c.emitted.x, 8.0f);
  EXPECT_TRUE(c.isDelta);
}

// KHR_lights_punctual: full inside the inner cone, nothing outside the outer one, between them the
// square of a linear ramp in the cosine.
TEST(Punctual, SpotFalloff) {
  builtin::SceneBuilder builder("spot");
  builder.add(triangle({-1, 0, -1}, {1, 0, -1}, {0, 0, 1}),
              builder.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  PunctualLight spot;
  spot.kind = rl::RL_LIGHT_SPOT;
  spot.posW = {0.0, 3.0, 0.0};
  spot.dirW = {0.0, -2.0, 0.0};
  spot.intensity = glm::vec3(9.0f);
  spot.innerConeAngle = 0.3f;
  spot.outerConeAngle = 0.6f;
  builder.addLight(spot);
  Dialect<> d(CompiledScene::build(builder.finish()));
  const rl::LightSample s = d->lightSample(rngOf(d, 0), anyReceiver());
  ASSERT_EQ(s.kind, rl::RL_LIGHT_SPOT);
  const glm::dvec3 position = spot.posW - d.compiledScene->origin();
  for (double angle = 0.0; angle < 1.5; angle += 0.01) {
    const glm::dvec3 direction(std::sin(angle), -std::cos(angle), 0.0);
    const rl::LightConnection c = d->lightConnect(s, glm::vec3(position + 2.0 * direction));
    const double ramp =
        std::clamp((std::cos(angle) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6)), 0.0, 1.0);
    EXPECT_NEAR(c.emitted.x, 9.0 / 4.0 * ramp * ramp, 1e-4) << angle;
  }
}

TEST(Mis, PowerHeuristicSumsToOne) {
  Dialect<> d;
  Inputs inputs(6);
  for (int i = 0; i < 100'000; ++i) {
    const float p = std::pow(10.0f, inputs.uniform(-30.0f, 30.0f)),
                q = std::pow(10.0f, inputs.uniform(-30.0f, 30.0f));
    const float weight = d->lightMisWeight(p, q);
    ASSERT_NEAR(weight + d->lightMisWeight(q, p), 1.0f, 1e-6f);
    const double a = double(p) * p, b = double(q) * q;
    ASSERT_NEAR(weight, a / (a + b), 1e-6);
  }
  EXPECT_EQ(d->lightMisWeight(1.0f, 0.0f), 1.0f);
  EXPECT_EQ(d->lightMisWeight(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(d->lightMisWeight(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(d->lightMisWeight(3e38f, 3e38f), 0.5f);
}

}  // namespace
}  // namespace restlab::unit
