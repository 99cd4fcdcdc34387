// The environment map: mapping, rotation, bilinear radiance, and sampling against its density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"
#include "experiments/statistics/sphere_grid.h"

namespace restlab::unit {
namespace {

EnvironmentMap noisyMap(uint32_t width, uint32_t height, float rotation, uint64_t seed) {
  EnvironmentMap map;
  map.width = width;
  map.height = height;
  map.rotation = rotation;
  Inputs inputs(seed);
  for (uint32_t i = 0; i < width * height; ++i) {
    const float r = inputs.scale(0.05f, 5.0f), g = inputs.scale(0.05f, 5.0f);
    map.radiance.emplace_back(r, g, inputs.scale(0.05f, 5.0f));
  }
  return map;
}

// A noisy map in which one texel is black and one is a sun.
EnvironmentMap harshMap(float rotation) {
  EnvironmentMap map = noisyMap(8, 4, rotation, 77);
  map.radiance[10] = glm::vec3(0.0f);
  map.radiance[21] = glm::vec3(5000.0f);
  return map;
}

// A map that is black except for one texel: most of the sphere must never be drawn.
EnvironmentMap lonelyMap() {
  EnvironmentMap map;
  map.width = 16;
  map.height = 8;
  map.radiance.assign(128, glm::vec3(0.0f));
  map.radiance[16 * 5 + 15] = glm::vec3(3.0f, 1.0f, 2.0f);
  return map;
}

std::shared_ptr<const CompiledScene> sceneWith(const EnvironmentMap& map) {
  builtin::SceneBuilder builder("sky");
  builder.add(builtin::quad("floor", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}),
              builder.addMaterial("floor", builtin::lambert(glm::vec3(0.5f))));
  builder.setEnvironment(map);
  return CompiledScene::build(builder.finish());
}

// World direction of texture coordinates, by the convention of scene.h: row 0 at +Y, u = 0.5 at -Z,
// turned by `rotation` about +Y.
glm::dvec3 directionOf(double u, double v, double rotation) {
  const double phi = (u - 0.5) * 2.0 * kPi, theta = v * kPi;
  const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                     -std::sin(theta) * std::cos(phi));
  const double c = std::cos(rotation), s = std::sin(rotation);
  return {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
}

TEST(Environment, UvIsTheInverseOfTheConvention) {
  for (float rotation : {0.0f, 1.0f, -2.5f, 7.0f}) {
    Dialect<> d(sceneWith(noisyMap(8, 4, rotation, 1)));
    Inputs inputs(2);
    for (int i = 0; i < 50'000; ++i) {
      const double u = inputs.uniform(0.001f, 0.999f), v = inputs.uniform(0.01f, 0.99f);
      const glm::vec2 uv = d->environmentUv(glm::vec3(directionOf(u, v, rotation)));
      ASSERT_NEAR(uv.x, u, 2e-5);
      ASSERT_NEAR(uv.y, v, 2e-5);
    }
    for (const glm::vec3& axis :
         {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
      const glm::vec2 uv = d->environmentUv(axis);
      EXPECT_TRUE(uv.x >= 0.0f && uv.x < 1.0f && uv.y >= 0.0f && uv.y < 1.0f);
    }
  }
}

// Known directions: the centre of the map looks along -Z, u = 0.75 to +X; a quarter turn about +Y
// carries -Z to -X.
TEST(Environment, Orientation) {
  EnvironmentMap map;
  map.width = 8;
  map.height = 4;
  map.radiance.assign(32, glm::vec3(0.001f));
  for (int y = 1; y < 3; ++y) {
    for (int x : {3, 4}) map.radiance[size_t(8 * y + x)] = glm::vec3(1, 0, 0);
    for (int x : {5, 6}) map.radiance[size_t(8 * y + x)] = glm::vec3(0, 1, 0);
  }
  for (int x = 0; x < 8; ++x) map.radiance[size_t(x)] = glm::vec3(0, 0, 1);
  Dialect<> straight(sceneWith(map));
  EXPECT_NEAR(straight->environmentRadiance({0, 0, -1}).x, 1.0f, 1e-3f);
  EXPECT_NEAR(straight->environmentRadiance({1, 0, 0}).y, 1.0f, 1e-3f);
  EXPECT_NEAR(straight->environmentRadiance({0, 1, 0}).z, 1.0f, 1e-3f);
  EXPECT_LT(glm::length(straight->environmentRadiance({0, 0, 1})), 0.01f);
  map.rotation = static_cast<float>(0.5 * kPi);
  Dialect<> turned(sceneWith(map));
  EXPECT_NEAR(turned->environmentRadiance({-1, 0, 0}).x, 1.0f, 1e-3f);
  EXPECT_NEAR(turned->environmentRadiance({0, 0, -1}).y, 1.0f, 1e-3f);
}

// Radiance is bilinear in texture coordinates, also across the seam, and scaled.
TEST(Environment, RadianceIsBilinear) {
  EnvironmentMap map = noisyMap(8, 4, 0.4f, 3);
  map.scale = 2.5f;
  Dialect<> d(sceneWith(map));
  Inputs inputs(4);
  for (int i = 0; i < 20'000; ++i) {
    const double u = inputs.uniform(0.0005f, 0.9995f), v = inputs.uniform(0.01f, 0.99f);
    const double x = u * 8 - 0.5, y = v * 4 - 0.5, fx = x - std::floor(x), fy = y - std::floor(y);
    auto texel = [&](int ix, int iy) {
      return glm::dvec3(map.radiance[size_t(std::clamp(iy, 0, 3) * 8 + (ix + 8) % 8)]) * 2.5;
    };
    const int ix = int(std::floor(x)), iy = int(std::floor(y));
    const glm::dvec3 expected = (texel(ix, iy) * (1 - fx) + texel(ix + 1, iy) * fx) * (1 - fy) +
                                (texel(ix, iy + 1) * (1 - fx) + texel(ix + 1, iy + 1) * fx) * fy;
    const glm::vec3 radiance = d->environmentRadiance(glm::vec3(directionOf(u, v, 0.4)));
    ASSERT_LT(glm::length(glm::dvec3(radiance) - expected), 2e-3 + 1e-3 * glm::length(expected));
  }
}

struct MapCase {
  const char* name;
  EnvironmentMap map;
};

std::vector<MapCase> mapCases() {
  return {{"8x4", noisyMap(8, 4, 0.0f, 5)},
          {"8x4 turned", noisyMap(8, 4, 2.2f, 6)},
          {"zero and sun", harshMap(0.0f)},
          {"zero and sun, turned", harshMap(-1.1f)},
          {"one texel", lonelyMap()},
          {"1x1", noisyMap(1, 1, 0.3f, 7)},
          {"not a power of two", noisyMap(15, 7, 0.5f, 8)}};
}

// Cells are finer than texels, to test the position inside a texel as well.
TEST(Environment, DrawsFollowTheDensity) {
  for (const MapCase& c : mapCases()) {
    Dialect<> d(sceneWith(c.map));
    const int nu = int(c.map.width) * 3, nv = int(c.map.height) * 3;
    std::vector<double> probabilities(size_t(nu) * nv);
    double total = 0.0;
    for (int y = 0; y < nv; ++y) {
      for (int x = 0; x < nu; ++x) {
        double sum = 0.0;
        for (int i = 0; i < 5; ++i) {
          for (int j = 0; j < 5; ++j) {
            const double u = (x + 0.5 + 0.5 * stats::kGauss5X[i]) / nu,
                         v = (y + 0.5 + 0.5 * stats::kGauss5X[j]) / nv;
            sum += 0.25 * stats::kGauss5W[i] * stats::kGauss5W[j] * std::sin(kPi * v) *
                   d->environmentPdf(glm::vec3(directionOf(u, v, c.map.rotation)));
          }
        }
        probabilities[size_t(y * nu + x)] = sum * 2.0 * kPi * kPi / (double(nu) * nv);
        total += probabilities[size_t(y * nu + x)];
      }
    }
    EXPECT_NEAR(total, 1.0, 1e-4) << c.name;
    std::vector<uint64_t> counts(probabilities.size());
    Inputs inputs(9);
    constexpr uint64_t n = 1'000'000;
    uint64_t different = 0;
    for (uint64_t i = 0; i < n; ++i) {
      float pdf = 0.0f;
      const uint32_t x = inputs.bits(), y = inputs.bits();
      const glm::vec3 direction = d->environmentDraw({x, y}, inputs.bits(), pdf);
      ASSERT_NEAR(glm::dot(direction, direction), 1.0f, 2e-6f);
      if (std::abs(d->environmentPdf(direction) / pdf - 1.0f) > 1e-2f) ++different;
      const glm::vec2 uv = d->environmentUv(direction);
      ++counts[size_t(std::min(int(uv.y * float(nv)), nv - 1) * nu +
                      std::min(int(uv.x * float(nu)), nu - 1))];
    }
    expectFits(counts, probabilities, n, c.name);
    // Rounding may carry a few draws over the border of their texel.
    EXPECT_LT(different, n / 50'000) << c.name;
  }
}

// Columns and thresholds are drawn with 32 bits: radiance over 12 decades in 8192 columns is drawn
// with the probability given by the density. Draws at every column's middle find its threshold.
TEST(Environment, DrawsWhatIsRareAsOftenAsTheDensitySays) {
  EnvironmentMap map;
  map.width = 8192;
  map.height = 2;
  for (uint32_t i = 0; i < map.width * map.height; ++i)
    map.radiance.emplace_back(std::pow(10.0f, -12.0f * float(i % 13u) / 12.0f));
  Dialect<> d(sceneWith(map));
  std::vector<double> drawn(map.width * map.height);
  for (uint32_t i = 0; i < drawn.size(); ++i) {
    const rl::AliasEntry& entry = d.scene.environmentAlias.data[i];
    drawn[i] += entry.keep / 4294967296.0 / double(drawn.size());
    drawn[entry.other] += (1.0 - entry.keep / 4294967296.0) / double(drawn.size());
    const auto middle = [&](uint32_t cell, uint32_t cells) {
      return uint32_t((uint64_t(2u * cell + 1u) << 31u) / cells);
    };
    const glm::uvec2 bits(middle(i % map.width, map.width), middle(i / map.width, map.height));
    for (const uint32_t aliasBits : {entry.keep - 1u, entry.keep}) {
      float pdf = 0.0f;
      const glm::vec2 uv = d->environmentUv(d->environmentDraw(bits, aliasBits, pdf));
      const uint32_t texel = uint32_t(uv.y * 2.0f) * map.width + uint32_t(uv.x * 8192.0f);
      ASSERT_EQ(texel, aliasBits < entry.keep ? i : entry.other) << i;
    }
  }
  for (uint32_t i = 0; i < drawn.size(); ++i)
    ASSERT_NEAR(d.scene.environmentAlias.data[i].pmf / drawn[i], 1.0, 1e-6) << i;
}

// Integrates the density over the sphere on a lattice unrelated to texels.
TEST(Environment, DensityIntegratesToOne) {
  for (const MapCase& c : mapCases()) {
    Dialect<> d(sceneWith(c.map));
    constexpr int n = 1'000'000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double z = 1.0 - 2.0 * (i + 0.5) / n, phi = 2.399963229728653 * i,
                   r = std::sqrt(1.0 - z * z);
      sum += d->environmentPdf(glm::vec3(r * std::cos(phi), z, r * std::sin(phi)));
    }
    EXPECT_NEAR(sum * 4.0 * kPi / n, 1.0, 3e-3) << c.name;
  }
}

// Importance sampling finds all the light: the mean of radiance / pdf is the flux.
TEST(Environment, EstimatesTheWholeSky) {
  for (const MapCase& c : mapCases()) {
    Dialect<> d(sceneWith(c.map));
    glm::dvec3 sum(0.0), squares(0.0), flux(0.0);
    Inputs inputs(12);
    constexpr int n = 200'000;
    for (int i = 0; i < n; ++i) {
      float pdf = 0.0f;
      const uint32_t x = inputs.bits(), y = inputs.bits();
      const glm::vec3 direction = d->environmentDraw({x, y}, inputs.bits(), pdf);
      const glm::dvec3 estimate = glm::dvec3(d->environmentRadiance(direction)) / double(pdf);
      sum += estimate / double(n);
      squares += estimate * estimate / double(n);
    }
    constexpr int m = 400;
    for (int y = 0; y < m; ++y) {
      for (int x = 0; x < 2 * m; ++x) {
        const double u = (x + 0.5) / (2 * m), v = (y + 0.5) / m;
        flux += glm::dvec3(d->environmentRadiance(glm::vec3(directionOf(u, v, c.map.rotation)))) *
                std::sin(kPi * v) * (kPi * kPi / (double(m) * m));
      }
    }
    for (int k = 0; k < 3; ++k) {
      const double error = std::sqrt(std::max(squares[k] - sum[k] * sum[k], 0.0) / n);
      EXPECT_NEAR(sum[k], flux[k], 5.0 * error + 1e-3 * flux[k]) << c.name << ", channel " << k;
    }
  }
}

// Pdf of the environment through the light table: selection times direction.
TEST(Environment, LightPdfIncludesTheSelection) {
  builtin::SceneBuilder builder("sky and lamp");
  builder.add(builtin::quad("lamp", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(1.0f))));
  builder.setEnvironment(harshMap(0.7f));
  Dialect<> d(CompiledScene::build(builder.finish()));
  const float pmf = d.scene.lights.data[d.scene.environmentLight].pmf;
  ASSERT_GT(pmf, 0.0f);
  ASSERT_LT(pmf, 1.0f);
  int seen = 0;
  for (uint32_t i = 0; i < 20'000; ++i) {
    const rl::Rng rng = d->rngInit(3, i, 0);
    const rl::LightSample s = d->lightSample(rng, anyReceiver());
    if (s.kind != rl::RL_LIGHT_ENVIRONMENT) continue;
    ++seen;
    const rl::LightConnection c = d->lightConnect(s, glm::vec3(0.3f));
    EXPECT_EQ(c.dirW, s.point);
    EXPECT_EQ(c.emitted, d->environmentRadiance(s.point));
    EXPECT_EQ(c.geometry, 1.0f);
    EXPECT_FALSE(c.isDelta);
    const float pdf = pmf * d->environmentPdf(c.dirW);
    EXPECT_FLOAT_EQ(d->lightPdfOfEnvironment(c.dirW), pdf);
    EXPECT_NEAR(c.pdfSolidAngle / pdf, 1.0f, 1e-2f);
  }
  EXPECT_NEAR(seen / 20'000.0, pmf, 0.02);
}

}  // namespace
}  // namespace restlab::unit
