// Squared bias of a method from all pairs of its runs: known answers, no bias of the estimate, and
// coverage of its interval.
#include "experiments/statistics/bias_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/error.h"

namespace restlab {

namespace {

Image constant(float x) { return Image(4, 4, glm::vec3(x)); }

BiasRuns runsOf(std::initializer_list<float> values) {
  BiasRuns runs;
  for (const float value : values) runs.add(constant(value));
  return runs;
}

TEST(BiasRuns, KnownAnswers) {
  const Image half = constant(1.0f);
  EXPECT_NEAR(runsOf({1.5f, 1.5f}).squaredBias(half, half).value, 0.25, 1e-7);
  EXPECT_NEAR(runsOf({1.5f, 1.5f}).biasRms(half, half).value, 0.5, 1e-7);
  EXPECT_EQ(runsOf({1.5f, 1.5f}).biasRms(half, half).detail, "squared bias +0.25");
  // Deviations of opposite sign are noise, not bias: a root of |...| would give a bias of 0.5.
  EXPECT_EQ(runsOf({1.5f, 0.5f}).biasRms(half, half).value, 0.0);
  EXPECT_EQ(runsOf({1.5f, 0.5f}).biasRms(half, half).detail, "squared bias -0.25");
  // (1 * 2 + 1 * -3 + 2 * -3) / 3, unlike the square of the mean, which is 0.
  EXPECT_NEAR(runsOf({2.0f, 3.0f, -2.0f}).squaredBias(half, half).value, -7.0 / 3.0, 1e-6);
  // Different halves: the mean of (1 * 3 + 2 * 2) / 2 for d = 1, 2 and e = 2, 3.
  EXPECT_NEAR(runsOf({2.0f, 3.0f}).squaredBias(half, constant(0.0f)).value, 3.5, 1e-6);
}

TEST(BiasRuns, MoreRunsThanGroupsWeighEveryPairAlike) {
  const Image half = constant(0.0f);
  BiasRuns runs;
  double first = 0.0, sum = 0.0;
  for (size_t r = 0; r <= BiasRuns::kGroups; ++r) {
    const double value = double(r % 3) - 0.5;
    if (r % BiasRuns::kGroups == 0) first += value;
    sum += value;
    runs.add(constant(float(value)));
  }
  // All ordered pairs of runs except those inside the first group, which has two runs.
  double expected = sum * sum - first * first;
  for (size_t r = 1; r < BiasRuns::kGroups; ++r)
    expected -= (double(r % 3) - 0.5) * (double(r % 3) - 0.5);
  const double n = double(BiasRuns::kGroups + 1);
  EXPECT_NEAR(runs.squaredBias(half, half).value, expected / (n * n - 4.0 - (n - 2.0)), 1e-6);
  EXPECT_EQ(runs.count(), BiasRuns::kGroups + 1);
}

TEST(BiasRuns, MasksSizesAndWhatIsNotFinite) {
  const Image half = constant(1.0f);
  Image left = constant(1.0f);
  for (uint32_t y = 0; y < 4; ++y) left.at(0, y) = glm::vec3(3.0f);
  BiasRuns runs;
  runs.add(left);
  EXPECT_TRUE(std::isnan(runs.squaredBias(half, half).value)) << "one run";
  runs.add(left);
  PixelMask mask(16, 0);
  mask[0] = mask[4] = 1;
  EXPECT_NEAR(runs.squaredBias(half, half).value, 1.0, 1e-6);
  EXPECT_NEAR(runs.squaredBias(half, half, mask).value, 4.0, 1e-6);
  EXPECT_THROW(runs.add(Image(3, 4, glm::vec3(1.0f))), Error);
  EXPECT_THROW(runs.squaredBias(Image(3, 4, glm::vec3(1.0f)), half), Error);
  left.at(1, 1).y = std::numeric_limits<float>::infinity();
  runs.add(left);
  EXPECT_TRUE(std::isnan(runs.squaredBias(half, half).value));
  const MetricValue value = runs.biasRms(half, half);
  EXPECT_TRUE(std::isnan(value.value));
  EXPECT_NE(value.detail.find("1 non-finite"), std::string::npos) << value.detail;
  EXPECT_FALSE(std::isnan(runs.squaredBias(half, half, mask).value)) << "outside the mask";
}

// Coverage of 1000 sets: 0.98 to 0.99 for a bias small against the noise (the jackknife overstates
// the variance of a degenerate U-statistic), 0.95 to 0.98 for a large one.
//
// Sets of runs with noise of deviation 1 and a bias of `bias` in every pixel.
struct Rates {
  double mean = 0.0, deviation = 0.0;  // mean and deviation of the estimate
  double held = 0.0;                   // fraction of intervals that contain the truth
};
Rates ratesOf(size_t runs, float bias, int sets) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise;
  constexpr uint32_t kSide = 12;
  const Image half(kSide, kSide, glm::vec3(0.0f));
  Rates rates;
  double squares = 0.0;
  for (int set = 0; set < sets; ++set) {
    BiasRuns all;
    for (size_t r = 0; r < runs; ++r) {
      Image image(kSide, kSide, glm::vec3(0.0f));
      for (glm::vec3& pixel : image.pixels)
        pixel = glm::vec3(noise(random), noise(random), noise(random)) + bias;
      all.add(image);
    }
    const Interval squared = all.squaredBias(half, half);
    const double truth = double(bias) * double(bias);
    rates.mean += squared.value / sets;
    squares += squared.value * squared.value / sets;
    rates.held += (squared.lo <= truth && truth <= squared.hi ? 1.0 : 0.0) / sets;
  }
  rates.deviation = std::sqrt(squares - rates.mean * rates.mean);
  return rates;
}

TEST(BiasRuns, IntervalsHoldTheTruth) {
  constexpr int kSets = 1000;
  for (const size_t runs : {3, 4, 8, 24}) {
    for (const float bias : {0.0f, 0.02f, 0.1f, 0.5f}) {
      const Rates rates = ratesOf(runs, bias, kSets);
      std::printf("%zu runs, bias %g: %.2e (%.1e), held %.3f\n", runs, double(bias), rates.mean,
                  rates.deviation, rates.held);
      EXPECT_NEAR(rates.mean, double(bias) * double(bias),
                  4.0 * rates.deviation / std::sqrt(double(kSets)));
      EXPECT_GE(rates.held, 0.93) << runs << " " << bias;
    }
  }
}

// The variance is 1 in every channel. In 1000 sets of 3, 8, 11 and 24 runs the interval contained
// it in 0.97 to 0.98.
TEST(BiasRuns, VarianceIsTheRestOfTheMse) {
  std::mt19937 random(11);
  std::normal_distribution<float> noise;
  constexpr uint32_t kSide = 10;
  const auto image = [&](float mean, float deviation) {
    Image made(kSide, kSide, glm::vec3(mean));
    for (glm::vec3& p : made.pixels)
      p += deviation * glm::vec3(noise(random), noise(random), noise(random));
    return made;
  };
  for (const size_t count : {3, 8, 11, 24}) {
    constexpr int kSets = 1000;
    double mean = 0.0, squares = 0.0, held = 0.0;
    for (int set = 0; set < kSets; ++set) {
      const Image half0 = image(0.0f, 0.5f), half1 = image(0.0f, 0.5f);
      BiasRuns runs;
      double mse = 0.0;
      for (size_t r = 0; r < count; ++r) {
        const Image run = image(0.3f, 1.0f);
        mse += mseAgainstHalves(run, half0, half1) / double(count);
        runs.add(run);
      }
      const Interval variance = runs.variance();
      if (count <= BiasRuns::kGroups) {
        ASSERT_NEAR(variance.value, mse - runs.squaredBias(half0, half1).value, 1e-6);
      }
      mean += variance.value / kSets;
      squares += variance.value * variance.value / kSets;
      held += (variance.lo <= 1.0 && 1.0 <= variance.hi ? 1.0 : 0.0) / kSets;
    }
    const double deviation = std::sqrt(squares - mean * mean);
    std::printf("%zu runs: %.4f (%.1e), held %.3f\n", count, mean, deviation, held);
    EXPECT_NEAR(mean, 1.0, 4.0 * deviation / std::sqrt(double(kSets)));
    EXPECT_GE(held, 0.93) << count;
  }
  BiasRuns one;
  one.add(image(0.0f, 1.0f));
  EXPECT_TRUE(std::isnan(one.variance().value));
}

}  // namespace

}  // namespace restlab
