// Flicker and correlation of errors on frames with known figures.
#include "experiments/runner/run/temporal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

constexpr uint32_t kSide = 64;

Reference referenceOf(float half0, float half1) {
  Reference reference;
  reference.half0 = Image(kSide, kSide, glm::vec3(half0));
  reference.half1 = Image(kSide, kSide, glm::vec3(half1));
  reference.mean = Image(kSide, kSide, glm::vec3(0.5f * (half0 + half1)));
  return reference;
}

TEST(Temporal, KnownFrames) {
  const Reference reference = referenceOf(1.0f, 1.0f);
  TemporalSum sum(reference);
  for (const float value : {2.0f, 0.0f, 2.0f, 0.0f}) sum.add(Image(8, 8, glm::vec3(value)));
  // Only the pixels of the frames count; the reference is larger.
  const TemporalFigures figures = sum.figures();
  EXPECT_NEAR(figures.variance, 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.difference, 2.0, 1e-12);
  EXPECT_NEAR(figures.errorDifferenceSquared, 4.0, 1e-12);
  EXPECT_NEAR(figures.autocorrelation[0], -1.0, 1e-12);
  EXPECT_NEAR(figures.autocorrelation[1], 1.0, 1e-12);
  EXPECT_NEAR(figures.autocorrelation[2], -1.0, 1e-12);
  EXPECT_TRUE(std::isnan(figures.autocorrelation[3])) << "four frames have three lags";
}

TEST(Temporal, OneFrameHasNoFigures) {
  const Reference reference = referenceOf(1.0f, 1.0f);
  TemporalSum sum(reference);
  sum.add(Image(4, 4, glm::vec3(2.0f)));
  EXPECT_TRUE(std::isnan(sum.figures().variance));
  EXPECT_TRUE(std::isnan(sum.figures().difference));
  Reference plain = reference;
  plain.half0.reset();
  plain.half1.reset();
  TemporalSum without(plain);
  without.add(Image(4, 4, glm::vec3(2.0f)));
  without.add(Image(4, 4, glm::vec3(3.0f)));
  EXPECT_TRUE(std::isnan(without.figures().autocorrelation[0])) << "no halves, no correlation";
  EXPECT_NEAR(without.figures().difference, 1.0, 1e-6);
}

// Autoregressive noise of known correlation, against a noisy reference.
TEST(Temporal, CorrelationOfKnownNoise) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  Reference reference = referenceOf(0.0f, 0.0f);
  for (glm::vec3& pixel : reference.half0->pixels) pixel = glm::vec3(0.5f * normal(random));
  for (glm::vec3& pixel : reference.half1->pixels) pixel = glm::vec3(0.5f * normal(random));
  TemporalSum sum(reference);
  const float rho = 0.8f;
  Image frame(kSide, kSide);
  for (glm::vec3& pixel : frame.pixels)
    pixel = glm::vec3(normal(random), normal(random), normal(random));
  for (int t = 0; t < 40; ++t) {
    sum.add(frame);
    for (glm::vec3& pixel : frame.pixels) {
      for (int c = 0; c < 3; ++c)
        pixel[c] = rho * pixel[c] + std::sqrt(1.0f - rho * rho) * normal(random);
    }
  }
  const TemporalFigures figures = sum.figures();
  for (int lag = 1; lag <= 8; ++lag)
    EXPECT_NEAR(figures.autocorrelation[size_t(lag) - 1], std::pow(0.8, lag), 0.03) << lag;
  // mean |f_t - f_{t-1}| of a difference with variance 2 (1 - rho).
  EXPECT_NEAR(figures.difference, std::sqrt(0.4) * std::sqrt(2.0 / 3.14159265), 0.01);
}

// Over 1000 sets of 8 runs of autoregressive noise, with these seeds: the intervals held the truth
// 957 times for the variance, 961 for the squared difference, 942 and 955 for the first two lags.
TEST(Temporal, IntervalsOverRunsHoldTheTruth) {
  constexpr int kSets = 1000, kRuns = 8, kFrames = 6;
  constexpr float kRho = 0.6f;
  constexpr uint32_t kSize = 12;
  Reference reference;
  reference.half0 = reference.half1 = reference.mean = Image(kSize, kSize);
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  int variances = 0, squares = 0, first = 0, second = 0;
  const auto holds = [](const std::vector<double>& runs, double truth) {
    const Interval interval = meanInterval(runs);
    return interval.lo <= truth && truth <= interval.hi;
  };
  for (int set = 0; set < kSets; ++set) {
    std::vector<double> variance, squared, lag1, lag2;
    for (int run = 0; run < kRuns; ++run) {
      TemporalSum sum(reference);
      Image frame(kSize, kSize);
      for (int t = 0; t < kFrames; ++t) {
        for (glm::vec3& pixel : frame.pixels) {
          for (int c = 0; c < 3; ++c)
            pixel[c] = t == 0 ? normal(random)
                              : kRho * pixel[c] + std::sqrt(1.0f - kRho * kRho) * normal(random);
        }
        sum.add(frame);
      }
      const TemporalFigures figures = sum.figures();
      variance.push_back(figures.variance);
      squared.push_back(figures.errorDifferenceSquared);
      lag1.push_back(figures.autocorrelation[0]);
      lag2.push_back(figures.autocorrelation[1]);
    }
    // Expected sample variance of n correlated frames: 1 - 2 / (n (n - 1)) sum (n - k) rho^k.
    double shared = 0.0;
    for (int k = 1; k < kFrames; ++k) shared += (kFrames - k) * std::pow(double(kRho), k);
    variances += holds(variance, 1.0 - 2.0 * shared / (kFrames * (kFrames - 1.0)));
    squares += holds(squared, 2.0 * (1.0 - double(kRho)));
    first += holds(lag1, double(kRho));
    second += holds(lag2, double(kRho) * double(kRho));
  }
  std::printf("    held: variance %d, squared difference %d, lags %d and %d of %d\n", variances,
              squares, first, second, kSets);
  // 950 expected; four standard deviations of a binomial are 28.
  for (const int held : {variances, squares, first, second}) EXPECT_NEAR(held, 950, 28);
}

// Returns the figures of two frames with noise 1 around a step of `moved` on a quarter of the
// pixels, with references of noise `ofHalf` in each half.
TemporalFigures figuresOfMotion(uint32_t seed, float moved, float ofHalf) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  const auto noisy = [&](bool isAfter, float strength) {
    Image image(16, 16);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const float truth = isAfter && i % 4 == 0 ? moved : 0.0f;
      for (int c = 0; c < 3; ++c) image.pixels[i][c] = truth + strength * normal(random);
    }
    return image;
  };
  std::vector<Reference> references(2);
  for (int after = 0; after < 2; ++after) {
    Reference& reference = references[size_t(after)];
    reference.half0 = noisy(after == 1, ofHalf);
    reference.half1 = noisy(after == 1, ofHalf);
    reference.mean = Image(16, 16);
    for (size_t i = 0; i < reference.mean.pixels.size(); ++i)
      reference.mean.pixels[i] = 0.5f * (reference.half0->pixels[i] + reference.half1->pixels[i]);
  }
  return figuresOfPair(noisy(false, 1.0f), noisy(true, 1.0f), references[0], references[1]);
}

// The squared change of errors is free of the references' noise; the difference of the references
// is not, but has a bound for it.
TEST(Temporal, NoiseOfTheReferencesIsOutOrSaid) {
  constexpr int kSets = 1000;
  for (const float ofHalf : {0.0f, 0.3f, 1.0f}) {
    double squared = 0.0, difference = 0.0, noise = 0.0;
    for (uint32_t seed = 0; seed < kSets; ++seed) {
      const TemporalFigures figures = figuresOfMotion(seed, 0.8f, ofHalf);
      squared += figures.errorDifferenceSquared / kSets;
      difference += figures.referenceDifference / kSets;
      noise += figures.referenceDifferenceNoise / kSets;
    }
    EXPECT_NEAR(squared, 2.0, 0.02) << ofHalf << ": twice the noise of a frame";
    const double excess = difference - 0.2;
    std::printf("    halves %.1f: excess %.4f, said %.4f\n", double(ofHalf), excess, noise);
    EXPECT_GE(noise, excess - 1e-6) << ofHalf;
    EXPECT_LE(noise, 1.6 * excess + 1e-6) << ofHalf;
  }
}

}  // namespace

}  // namespace restlab
