// Noise of a reference's halves, which all runs share: its estimates, and the coverage of intervals
// of MSE, squared bias and ratios with it.
#include "experiments/statistics/halves_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/base/error.h"
#include "experiments/statistics/bias_runs.h"

namespace restlab {

namespace {

constexpr uint32_t kSide = 12;
constexpr int kNoiseSets = 1000;

Image constantImage(float x) { return Image(2, 1, glm::vec3(x)); }

TEST(HalvesNoise, KnownAnswers) {
  Image half0 = constantImage(1.0f), half1 = constantImage(1.0f);
  EXPECT_EQ(halvesNoise(half0, half1).varianceOfProduct, 0.0);
  half0.at(0, 0) = glm::vec3(3.0f, 1.0f, 2.0f);  // d = 2, 0, 1
  const HalvesNoise noise = halvesNoise(half0, half1);
  EXPECT_NEAR(noise.varianceOfHalf, 5.0 / 2.0 / 6.0, 1e-12);
  EXPECT_NEAR(noise.varianceOfProduct, 25.0 / 12.0 / 36.0, 1e-12);
  EXPECT_NEAR(halvesNoise(half0, half1, {1, 0}).varianceOfHalf, 5.0 / 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(halvesNoise(half0, half1, {1, 0}).varianceOfProduct, 25.0 / 12.0 / 9.0, 1e-12);
  // The mean of the halves is (2, 1, 1.5): x of a run of 4 is (2, 3, 2.5), x d = 6.5; x of a run of
  // 1 is (-1, 0, -0.5), x d = -2.5.
  EXPECT_NEAR(sharedVarianceAtMost(constantImage(4.0f), half0, half1), 6.5 * 6.5 / 36.0, 1e-12);
  EXPECT_NEAR(sharedVariance({constantImage(4.0f), constantImage(1.0f)}, half0, half1),
              -6.5 * 2.5 / 36.0, 1e-12);
  EXPECT_NEAR(
      sharedVariance({constantImage(4.0f), constantImage(4.0f), constantImage(1.0f)}, half0, half1),
      (6.5 * 6.5 - 2.0 * 6.5 * 2.5) / 3.0 / 36.0, 1e-12);
  // sharedVariance() of runs is at least that of the halves alone.
  BiasRuns runs;
  runs.add(constantImage(4.0f));
  EXPECT_EQ(runs.sharedVariance(half0, half1), noise.varianceOfProduct);
  runs.add(constantImage(1.0f));
  EXPECT_EQ(runs.sharedVariance(half0, half1), noise.varianceOfProduct);
  EXPECT_THROW(halvesNoise(half0, Image(1, 1, glm::vec3(1.0f))), Error);
  EXPECT_THROW(sharedVariance({Image(1, 1, glm::vec3(1.0f))}, half0, half1), Error);
  EXPECT_THROW(sharedVarianceAtMost(Image(1, 1, glm::vec3(1.0f)), half0, half1), Error);
}

// Noise of mean 0 and variance 1, averaged over pixels and channels.
using Noise = std::function<glm::vec3(std::mt19937&, size_t pixel)>;

glm::vec3 ofChannels(std::mt19937& random, size_t) {
  std::normal_distribution<float> normal;
  const float r = normal(random), g = normal(random), b = normal(random);
  return {r, g, b};
}

glm::vec3 grey(std::mt19937& random, size_t) {
  std::normal_distribution<float> normal;
  return glm::vec3(normal(random));
}

// Noise with nine times the variance in a quarter of the pixels.
glm::vec3 uneven(std::mt19937& random, size_t pixel) {
  return grey(random, pixel) * std::sqrt(pixel % 4 == 0 ? 3.0f : 1.0f / 3.0f);
}

Image imageOf(std::mt19937& random, const Noise& noise, double variance, float bias) {
  Image image(kSide, kSide);
  for (size_t p = 0; p < image.pixels.size(); ++p)
    image.pixels[p] = noise(random, p) * float(std::sqrt(variance)) + bias;
  return image;
}

struct Case {
  const char* name;
  Noise noise;
  double ratio;  // variance of a run over that of a half, which is 1
  float bias;
};

struct NoiseRates {
  double mse = 0.0, squaredBias = 0.0, ratio = 0.0;  // fractions of intervals with the truth
  double withoutNoise = 0.0;                         // for the MSE, by the spread of runs alone
};

NoiseRates ratesOf(const Case& of) {
  std::mt19937 random(11);
  NoiseRates rates;
  const auto count = [](double& rate, const Interval& interval, double truth) {
    rate += (interval.lo <= truth && truth <= interval.hi ? 1.0 : 0.0) / kNoiseSets;
  };
  const double pathVariance = 4.0 * of.ratio, truth = of.ratio + double(of.bias) * double(of.bias);
  for (int set = 0; set < kNoiseSets; ++set) {
    const Image half0 = imageOf(random, of.noise, 1.0, 0.0f),
                half1 = imageOf(random, of.noise, 1.0, 0.0f);
    BiasRuns runs, path;
    std::vector<double> mse, pathMse;
    for (int r = 0; r < 8; ++r) {
      const Image run = imageOf(random, of.noise, of.ratio, of.bias);
      const Image ofPath = imageOf(random, of.noise, pathVariance, 0.0f);
      runs.add(run);
      path.add(ofPath);
      mse.push_back(mseAgainstHalves(run, half0, half1));
      pathMse.push_back(mseAgainstHalves(ofPath, half0, half1));
    }
    const double shared = runs.sharedVariance(half0, half1);
    count(rates.mse, widened(meanInterval(mse), shared), truth);
    count(rates.withoutNoise, meanInterval(mse), truth);
    count(rates.squaredBias, runs.squaredBias(half0, half1), double(of.bias) * double(of.bias));
    count(rates.ratio,
          pairedRatioInterval(pathMse, mse,
                              {path.sharedVariance(half0, half1), shared,
                               halvesNoise(half0, half1).varianceOfProductAtLeast()}),
          pathVariance / truth);
  }
  return rates;
}

// Sets of 8 runs of 12x12 pixels, at MSEs of 4.5, 2, 1 and 0.5 times the variance of a half.
TEST(HalvesNoise, IntervalsHoldTheTruth) {
  for (const double ratio : {4.5, 2.0, 1.0, 0.5}) {
    for (const float bias : {0.0f, 0.7f}) {
      for (const Case& of :
           {Case{"channels", ofChannels, ratio, bias}, Case{"grey", grey, ratio, bias},
            Case{"uneven", uneven, ratio, bias}}) {
        const NoiseRates rates = ratesOf(of);
        std::printf(
            "    %-8s ratio %.1f, bias %.1f: MSE %.3f (%.3f by the spread of runs), "
            "bias^2 %.3f, ratio %.3f\n",
            of.name, ratio, double(bias), rates.mse, rates.withoutNoise, rates.squaredBias,
            rates.ratio);
        EXPECT_GE(rates.mse, 0.93) << of.name << " " << ratio << " " << bias;
        EXPECT_GE(rates.squaredBias, 0.93) << of.name << " " << ratio << " " << bias;
        EXPECT_GE(rates.ratio, 0.93) << of.name << " " << ratio << " " << bias;
      }
    }
  }
}

}  // namespace

}  // namespace restlab
