// Metrics against values computed with NumPy from the same formulas, and their handling of bad
// input.
#include "core/image/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "core/base/error.h"
#include "tests/image/known_pair.h"

namespace restlab {
namespace {

using image_test::KnownPair;

TEST(Metrics, KnownValues) {
  const KnownPair pair;
  const auto value = [&](const char* name) {
    return evaluateMetric(name, pair.image, pair.reference).value;
  };
  EXPECT_NEAR(value("mse"), 0.001384607950846354, 1e-15);
  EXPECT_NEAR(value("rmse"), 0.037210320488358525, 1e-14);
  EXPECT_NEAR(value("mae"), 0.032215711805555554, 1e-14);
  EXPECT_NEAR(value("relmse_e1e-2"), 0.021182849602953628, 1e-14);
  EXPECT_NEAR(value("relmse_e1e-2_trim0.1"), 0.021013472470157068, 1e-14);
  EXPECT_NEAR(value("mape_e1e-2"), 0.1780654152410994, 1e-13);
  EXPECT_NEAR(value("smape"), 0.14208042700179596, 1e-13);
  EXPECT_NEAR(value("psnr"), 28.44994329803807, 1e-11);
  EXPECT_NEAR(value("energy_ratio"), 0.9999335389196087, 1e-13);
  EXPECT_EQ(value("max_err"), 0.0625);
  EXPECT_EQ(value("nonfinite"), 0.0);
  const glm::dvec3 ratio = energyRatioPerChannel(pair.image, pair.reference);
  EXPECT_NEAR(ratio.x, 1.0007999146757678, 1e-13);
  EXPECT_NEAR(ratio.y, 0.999202467035304, 1e-13);
  EXPECT_NEAR(ratio.z, 0.9998012086513994, 1e-13);
}

TEST(Metrics, DetailsSayWhatTheNumberNeeds) {
  KnownPair pair;
  const auto detail = [&](const char* name) {
    return evaluateMetric(name, pair.image, pair.reference).detail;
  };
  EXPECT_EQ(detail("relmse_e1e-2_trim0.1"), "dropped 1 of 1200 pixels");
  EXPECT_EQ(detail("psnr"), "peak 0.984375");
  EXPECT_EQ(detail("max_err"), "at x 0 y 0 channel R");
  pair.image.at(17, 23).z = 50.0f;
  EXPECT_EQ(detail("max_err"), "at x 17 y 23 channel B");
}

TEST(Metrics, IdenticalImages) {
  const Image image(5, 4, glm::vec3(0.5f, 2.0f, 0.0f));
  for (const MetricInfo& metric : metricRegistry()) {
    if (metric.needsRuns) continue;
    const double value = metric.function(image, image, {}).value;
    if (metric.name == "energy_ratio") {
      EXPECT_EQ(value, 1.0);
    } else if (metric.name == "ssim") {
      EXPECT_NEAR(value, 1.0, 1e-12);
    } else if (metric.name == "psnr") {
      EXPECT_EQ(value, std::numeric_limits<double>::infinity());
    } else {
      EXPECT_EQ(value, 0.0) << metric.name;
    }
  }
}

TEST(Metrics, FlagsAndFormulas) {
  const std::set<std::string> promised = {
      "mse",        "rmse",          "mae",          "relmse_e1e-2", "relmse_e1e-2_trim0.1",
      "mape_e1e-2", "mape_mean1e-2", "smape",        "psnr",         "ssim",
      "flip_ldr",   "flip_hdr",      "energy_ratio", "bias_rms",     "nonfinite",
      "max_err"};
  for (const std::string& name : promised) EXPECT_EQ(findMetric(name).name, name);
  std::set<std::string> names;
  for (const MetricInfo& metric : metricRegistry()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name << " is registered twice";
    EXPECT_FALSE(metric.formula.empty()) << metric.name;
    EXPECT_EQ(metric.higherIsBetter, metric.name == "psnr" || metric.name == "ssim");
  }
  EXPECT_EQ(names.size(), metricNames().size());
}

TEST(Metrics, OneBadValueMakesEveryMetricNan) {
  const KnownPair good;
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (const float value : bad) {
    for (const bool inReference : {false, true}) {
      KnownPair pair = good;
      (inReference ? pair.reference : pair.image).at(39, 29).y = value;
      for (const MetricInfo& metric : metricRegistry()) {
        const MetricValue result = metric.function(pair.image, pair.reference, {});
        if (metric.name == "nonfinite") {
          EXPECT_EQ(result.value, inReference ? 0.0 : 1.0);
        } else {
          EXPECT_TRUE(std::isnan(result.value)) << metric.name << " " << value;
          EXPECT_NE(result.detail.find("1 "), std::string::npos) << result.detail;
        }
      }
      EXPECT_TRUE(std::isnan(mseAgainstHalves(pair.image, pair.reference, pair.reference)));
      // Equal values in both images cancel in the difference; the verdict must still be NaN.
      pair.image.at(39, 29).y = pair.reference.at(39, 29).y = value;
      EXPECT_TRUE(std::isnan(evaluateMetric("mse", pair.image, pair.reference).value));
    }
  }
}

TEST(Metrics, BlackReferenceGivesNoNumberOutOfNothing) {
  const Image black(4, 4), grey(4, 4, glm::vec3(0.5f));
  EXPECT_TRUE(std::isnan(evaluateMetric("psnr", grey, black).value));
  EXPECT_EQ(evaluateMetric("energy_ratio", grey, black).value,
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(evaluateMetric("energy_ratio", black, black).value));
  EXPECT_NEAR(evaluateMetric("relmse_e1e-2", grey, black).value, 25.0, 1e-12);
}

TEST(Metrics, UsersErrors) {
  const Image a(4, 4), b(4, 5), none;
  const auto code = [](auto action) {
    try {
      action();
    } catch (const Error& error) {
      return int(error.code());
    }
    return 0;
  };
  EXPECT_EQ(code([&] { evaluateMetric("mse", a, b); }), int(ExitCode::badInput));
  EXPECT_EQ(code([&] { evaluateMetric("mse", none, none); }), int(ExitCode::badInput));
  EXPECT_EQ(code([&] { mseAgainstHalves(a, a, b); }), int(ExitCode::badInput));
  EXPECT_EQ(code([&] { mseAgainstHalves(a, a, a, std::vector<uint8_t>(16, 0)); }),
            int(ExitCode::badInput));
  EXPECT_EQ(code([&] { mseAgainstHalves(a, a, a, std::vector<uint8_t>(15, 1)); }),
            int(ExitCode::badInput));
  EXPECT_EQ(code([&] { squaredErrorPerPixel(a, b); }), int(ExitCode::badInput));
  try {
    findMetric("relmse_e1e-3");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(int(error.code()), int(ExitCode::badUsage));
    EXPECT_NE(std::string(error.what()).find("'relmse_e1e-2'"), std::string::npos) << error.what();
  }
}

// Known answers of the relative error, with constant images and halves.
TEST(Metrics, RelativeErrorAgainstHalves) {
  const Image image(2, 1, glm::vec3(3.0f)), divisor(2, 1, glm::vec3(2.0f));
  Image half0(2, 1, glm::vec3(1.0f)), half1(2, 1, glm::vec3(2.5f));
  half0.at(1, 0) = glm::vec3(3.5f);
  // (2 * 0.5 - 0.5 * 0.5) / 2 over 2^2 + 0.01, signed.
  const RelativeError error = relmseAgainstHalves(image, divisor, half0, half1);
  EXPECT_NEAR(error.relmse, 0.375 / 4.01, 1e-12);
  EXPECT_NEAR(error.trimmed, 0.375 / 4.01, 1e-12) << "a thousandth of two pixels is none";
  EXPECT_EQ(error.detail, "dropped 0 of 2 pixels");
  EXPECT_NEAR(relmseAgainstHalves(image, divisor, half0, half1, {1, 0}).relmse, 1.0 / 4.01, 1e-12);
  // With the reference as both halves, the results are the metrics of the registry.
  const RelativeError plain = relmseAgainstHalves(image, half0, half0, half0);
  EXPECT_NEAR(plain.relmse, evaluateMetric("relmse_e1e-2", image, half0).value, 1e-12);
  EXPECT_NEAR(plain.trimmed, evaluateMetric("relmse_e1e-2_trim0.1", image, half0).value, 1e-12);
  half0.at(1, 0).y = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(std::isnan(relmseAgainstHalves(image, half0, half0, half1).relmse));
  EXPECT_TRUE(std::isnan(relmseAgainstHalves(image, half0, half0, half1).trimmed));
  EXPECT_THROW(relmseAgainstHalves(image, Image(1, 1, glm::vec3(1.0f)), half0, half1), Error);
}

TEST(Metrics, HalvesCarryNoErrorOfTheReference) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  Image image(256, 256), half0 = image, half1 = image, mean = image;
  std::vector<uint8_t> mask(image.pixels.size(), 0);
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      const float truth = float(p % 17);
      image.pixels[p][c] = truth + 0.5f * normal(random);
      half0.pixels[p][c] = truth + normal(random) / 3.0f;
      half1.pixels[p][c] = truth + normal(random) / 3.0f;
      mean.pixels[p][c] = 0.5f * (half0.pixels[p][c] + half1.pixels[p][c]);
    }
    mask[p] = p % 2 == 0 ? 1 : 0;
  }
  // Standard error of the mean product of two such deviations over 196608 values: below 0.001.
  EXPECT_NEAR(mseAgainstHalves(image, half0, half1), 0.25, 0.005);
  EXPECT_NEAR(mseAgainstHalves(image, half0, half1, mask), 0.25, 0.007);
  EXPECT_NEAR(evaluateMetric("mse", image, mean).value, 0.25 + 1.0 / 18.0, 0.005);
  // The truth itself has no error, whatever the noise of the halves: about 0, of either sign.
  Image exact = image;
  for (size_t p = 0; p < exact.pixels.size(); ++p) exact.pixels[p] = glm::vec3(float(p % 17));
  EXPECT_NEAR(mseAgainstHalves(exact, half0, half1), 0.0, 0.002);
  // Two disjoint sets of runs of an unbiased method show no bias, though each is noisy.
  Image other = image;
  for (size_t p = 0; p < other.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) other.pixels[p][c] = float(p % 17) + 0.5f * normal(random);
  }
  EXPECT_NEAR(squaredBias(image, other, half0, half1), 0.0, 0.003);
  for (Image* shifted : {&image, &other}) {
    for (glm::vec3& pixel : shifted->pixels) pixel += glm::vec3(0.5f);
  }
  EXPECT_NEAR(squaredBias(image, other, half0, half1), 0.25, 0.01);
}

TEST(Metrics, MaskSelectsPixels) {
  const KnownPair pair;
  std::vector<uint8_t> mask(pair.image.pixels.size(), 0);
  mask[5 * 40 + 3] = 255;
  const glm::dvec3 d = glm::dvec3(pair.image.at(3, 5)) - glm::dvec3(pair.reference.at(3, 5));
  EXPECT_NEAR(mseAgainstHalves(pair.image, pair.reference, pair.reference, mask),
              glm::dot(d, d) / 3.0, 1e-15);
}

TEST(Metrics, WorstPixels) {
  const KnownPair pair;
  const std::vector<double> errors = squaredErrorPerPixel(pair.image, pair.reference);
  EXPECT_NEAR(worstPixelShare(errors), 0.004144855664738115, 1e-14);  // 2 of 1200 pixels
  EXPECT_NEAR(worstPixelShare(errors, 0.01), 0.02486913398842868, 1e-14);
  EXPECT_NEAR(worstPixelShare(errors, 1.0), 1.0, 1e-12);
  EXPECT_EQ(worstPixelShare({0.0, 0.0}), 0.0);
  EXPECT_EQ(worstPixelShare({3.0, 1.0}), 0.75);
  EXPECT_TRUE(std::isnan(worstPixelShare({-1.0, 0.5})));
  EXPECT_TRUE(std::isnan(worstPixelShare({std::nan(""), 0.5})));
}

}  // namespace
}  // namespace restlab
