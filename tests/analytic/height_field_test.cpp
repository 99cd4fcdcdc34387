// The virtual gonioreflectometer against surfaces whose BRDF is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.h"
#include "experiments/bsdf/simulate.h"

namespace restlab {
namespace {

using std::numbers::pi;

// Heights with Gaussian slopes: waves of random directions and phases that repeat with the field.
HeightField gaussianField(uint32_t side, double slope) {
  constexpr int kWaves = 400;
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, double(side) / 30.0);
  std::vector<double> sum(size_t(side) * side, 0.0);
  double squares = 0.0;  // of slopes, mean
  for (int w = 0; w < kWaves; ++w) {
    const double kx = std::round(normal(engine)), ky = std::round(normal(engine));
    const double phase = 2.0 * pi * uniform(engine), step = 2.0 * pi / side;
    squares += 0.5 * (kx * kx + ky * ky) * step * step;
    for (uint32_t y = 0; y < side; ++y) {
      for (uint32_t x = 0; x < side; ++x)
        sum[size_t(y) * side + x] += std::cos(step * (kx * x + ky * y) + phase);
    }
  }
  HeightField field{Image(side, side), 1.0};
  for (size_t i = 0; i < sum.size(); ++i)
    field.heights.pixels[i] = glm::vec3(float(sum[i] * slope / std::sqrt(squares)));
  return field;
}

// Share of the light of row i that goes to one cell.
double energyOf(const ClosureTable& table, uint32_t i, uint32_t j, uint32_t k) {
  const glm::uvec3 n = table.sizes;
  const double low = std::sin(0.5 * pi * j / n.y), high = std::sin(0.5 * pi * (j + 1.0) / n.y);
  return double(table.at(i, j, k).x) * pi / n.z * (high * high - low * low);
}
double albedoOf(const ClosureTable& table, uint32_t i) {
  double sum = 0.0;
  for (uint32_t j = 0; j < table.sizes.y; ++j) {
    for (uint32_t k = 0; k < table.sizes.z; ++k) sum += energyOf(table, i, j, k);
  }
  return sum;
}

// D G / (4 cos cos) of Beckmann's facets with Smith's masking (Walter et al. 2007, exact Lambda).
double beckmann(const glm::dvec3& wo, const glm::dvec3& wi, double alpha) {
  const glm::dvec3 h = glm::normalize(wo + wi);
  const double tan2 = (1.0 - h.z * h.z) / (h.z * h.z);
  const double d = std::exp(-tan2 / (alpha * alpha)) / (pi * alpha * alpha * std::pow(h.z, 4.0));
  const auto lambda = [alpha](double z) {
    const double a = z / (alpha * std::sqrt(std::max(1.0 - z * z, 1e-12)));
    return 0.5 * (std::erf(a) - 1.0) + std::exp(-a * a) / (2.0 * a * std::sqrt(pi));
  };
  return d / (1.0 + lambda(wo.z) + lambda(wi.z)) / (4.0 * wo.z * wi.z);
}

TEST(HeightFields, AFlatLambertSurfaceIsLambert) {
  SimulationConfig config;
  config.albedo = 0.6;
  config.samples = 200'000;
  config.sizes = {8, 8, 8};
  const Simulation result = simulateBrdf({Image(4, 4, glm::vec3(1.0f)), 0.5}, config);
  EXPECT_EQ(result.slope, 0.0);
  EXPECT_LT(result.lostRays, 100u);
  EXPECT_EQ(result.absorbed, 0.0);
  for (uint32_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(albedoOf(result.table, i), 0.6, 0.01) << i;
    EXPECT_NEAR(result.table.at(i, 3, 4).x, 0.6 / pi, 0.06 * 0.6 / pi) << i;
  }
}

// Facets of mirror: what they reflect once is the microfacet formula of their own slopes.
TEST(HeightFields, GaussianMirrorsAreBeckmannFacets) {
  SimulationConfig config;
  config.base = FacetBase::mirror;
  config.bounces = 1;
  config.samples = 300'000;
  config.sizes = {18, 18, 18};
  const Simulation result = simulateBrdf(gaussianField(256, 0.25), config);
  EXPECT_NEAR(result.slope, 0.25, 0.02);
  const ClosureTable& table = result.table;
  const ClosureTable exact =
      tabulate([&](const glm::dvec3& wo,
                   const glm::dvec3& wi) { return glm::dvec3(beckmann(wo, wi, result.slope)); },
               TableAngles::directions, {54u, 54u, 54u});
  for (const uint32_t i : {2u, 5u, 8u}) {  // 12, 27 and 42 degrees
    double difference = 0.0, all = 0.0;
    for (uint32_t j = 0; j < 18; ++j) {
      for (uint32_t k = 0; k < 18; ++k) {
        double expected = 0.0;  // over the finer cells of this one
        for (uint32_t c = 0; c < 27; ++c)
          expected += energyOf(exact, 3 * i + c / 9, 3 * j + c / 3 % 3, 3 * k + c % 3) / 3.0;
        const double energy = energyOf(table, i, j, k);
        difference += std::abs(energy - expected);
        all += expected;
      }
    }
    EXPECT_NEAR(all, 1.0, 0.02) << i;
    EXPECT_LT(difference, 0.1) << i << ": share of the light that goes elsewhere";
  }
}

// White facets return all light in the end; the first event alone loses what hits others.
TEST(HeightFields, BouncesReturnWhatTheFirstLost) {
  SimulationConfig config;
  config.samples = 20'000;
  config.sizes = {6, 6, 6};
  const HeightField field = gaussianField(64, 1.0);
  config.bounces = 1;
  const Simulation once = simulateBrdf(field, config);
  config.bounces = 64;
  const Simulation often = simulateBrdf(field, config);
  EXPECT_GT(once.absorbed, 0.1);
  EXPECT_LT(often.absorbed, 1e-3);
  double sum = 0.0;
  for (uint32_t i = 0; i < 6; ++i) sum += albedoOf(often.table, i) / 6.0;
  EXPECT_NEAR(sum, 1.0, 0.02);
}

TEST(HeightFields, FaultsAreOneLine) {
  const auto errorOf = [](const Image& heights) -> std::string {
    try {
      simulateBrdf({heights, 1.0}, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(errorOf(Image(1, 1)), "a height field of 1x1; at least 2x2 heights expected");
  Image heights(3, 2);
  heights.at(2, 1).x = std::nanf("");
  EXPECT_EQ(errorOf(heights), "the height of pixel (2, 1) is not finite");
}

}  // namespace
}  // namespace restlab
