// Flicker and correlation of errors, on frames whose figures are known.
#include "experiments/runner/temporal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
  // The reference is larger: only the pixels of the frames count.
  const TemporalFigures figures = sum.figures();
  EXPECT_NEAR(figures.variance, 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(figures.difference, 2.0, 1e-12);
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

// An autoregressive noise of known correlation, against a reference that is noisy itself.
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

}  // namespace

}  // namespace restlab
