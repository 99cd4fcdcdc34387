// The noise that a reference adds to the MSE of every run alike.
#include "experiments/runner/reference_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace restlab {

namespace {

// Halves of a black reference, each channel with Gaussian noise; the same in all three or not.
Reference noisyReference(uint32_t seed, bool isGrey) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Reference reference;
  reference.half0 = Image(16, 16);
  reference.half1 = Image(16, 16);
  for (Image* half : {&*reference.half0, &*reference.half1}) {
    for (size_t i = 0; i < half->pixels.size(); ++i) {
      const float strength = i % 4 == 0 ? 2.0f : 0.5f;
      const float grey = strength * normal(random);
      half->pixels[i] = isGrey
                            ? glm::vec3(grey)
                            : glm::vec3(grey, strength * normal(random), strength * normal(random));
    }
  }
  reference.mean = *reference.half0;
  return reference;
}

// Root mean squares over references: of mean n0 n1, and of what is said of it.
std::pair<double, double> trueAndSaid(bool isGrey) {
  constexpr int kSets = 2000;
  double added = 0.0, said = 0.0;
  for (uint32_t seed = 0; seed < kSets; ++seed) {
    const Reference reference = noisyReference(seed, isGrey);
    // A black image is without error.
    const double mse = mseAgainstHalves(Image(16, 16), *reference.half0, *reference.half1);
    added += mse * mse;
    said += std::pow(sharedNoiseOfMse(reference), 2.0);
  }
  return {std::sqrt(added / kSets), std::sqrt(said / kSets)};
}

TEST(ReferenceNoise, IsThatOfTheErrors) {
  const auto [added, said] = trueAndSaid(true);
  std::printf("    added %.5f, said %.5f\n", added, said);
  EXPECT_NEAR(said / added, 1.0, 0.1);
}

TEST(ReferenceNoise, IsNoLessWhereChannelsHaveTheirOwn) {
  const auto [added, said] = trueAndSaid(false);
  std::printf("    added %.5f, said %.5f\n", added, said);
  EXPECT_GT(said / added, 1.0);
  EXPECT_LT(said / added, 1.5);
}

TEST(ReferenceNoise, IsUnknownWithoutHalves) {
  Reference reference = noisyReference(1, true);
  reference.half0.reset();
  reference.half1.reset();
  EXPECT_EQ(sharedNoiseOfMse(reference), 0.0);
}

}  // namespace

}  // namespace restlab
