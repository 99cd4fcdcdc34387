// Sums of frames: mean and variance of the mean of known samples.
#include "experiments/statistics/image_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/runner/base/files.h"

namespace restlab {

namespace {

Image constant(float value) { return Image(2, 1, glm::vec3(value, 2.0f * value, 0.0f)); }

TEST(ImageSum, MeanOfBothWeighsBySamples) {
  ImageSum a, b;
  a.add(constant(1.0f));
  a.add(constant(2.0f));
  b.add(constant(6.0f));
  EXPECT_EQ(a.mean().at(1, 0), glm::vec3(1.5f, 3.0f, 0.0f));
  EXPECT_EQ(ImageSum::meanOfBoth(a, b).at(0, 0), glm::vec3(3.0f, 6.0f, 0.0f));
  EXPECT_EQ(ImageSum::meanOfBoth(a, ImageSum()).at(0, 0), glm::vec3(1.5f, 3.0f, 0.0f));
}

TEST(ImageSum, VarianceOfTheMean) {
  ImageSum a, b, squares;
  for (const float value : {1.0f, 2.0f}) a.add(constant(value));
  for (const float value : {3.0f, 4.0f}) b.add(constant(value));
  for (const float value : {1.0f, 3.0f, 2.0f, 4.0f}) squares.addSquares(constant(value));
  // Samples 1 2 3 4: variance 5/3, variance of the mean 5/12.
  const Image variance = ImageSum::varianceOfMean(a, b, squares);
  EXPECT_NEAR(variance.at(0, 0).x, 5.0 / 12.0, 1e-6);
  EXPECT_NEAR(variance.at(0, 0).y, 4.0 * 5.0 / 12.0, 1e-6);
  EXPECT_EQ(variance.at(0, 0).z, 0.0f);
}

TEST(ImageSum, SmallTermsAreNotLost) {
  ImageSum sum;
  sum.add(constant(1e7f));
  for (int i = 0; i < 1000; ++i) sum.add(constant(0.25f));
  EXPECT_NEAR(sum.mean().at(0, 0).x, (1e7 + 250.0) / 1001.0, 1e-2);
}

TEST(HistoryMean, OfFramesThatStandAloneIsTheirMean) {
  HistoryMean history(1.0);
  for (const float value : {1.0f, 2.0f, 6.0f}) history.add(constant(value));
  EXPECT_EQ(history.frames(), 3u);
  EXPECT_EQ(history.mean().at(0, 0), glm::vec3(3.0f, 6.0f, 0.0f));
}

// Frames are exponential averages of samples. Each sample has its own pixel, so the pixels of the
// accumulated image are the weights of the samples.
TEST(HistoryMean, WeighsSamplesOfAveragesAlike) {
  constexpr uint32_t kAll = 96, kAveraged = 21;
  HistoryMean history(kAveraged);
  Image average(kAll, 1, glm::vec3(0.0f));
  for (uint32_t n = 1; n <= kAll; ++n) {
    const float weight = 1.0f / float(std::min(n, kAveraged));
    for (uint32_t s = 0; s < kAll; ++s)
      average.at(s, 0) = average.at(s, 0) * (1.0f - weight) + glm::vec3(s + 1 == n ? weight : 0.0f);
    history.add(average);
    if (n > kAveraged) continue;
    EXPECT_NEAR(history.mean().at(0, 0).x, 1.0f / float(n), 1e-6);
  }
  const Image weights = history.mean();
  const float alike = weights.at(0, 0).x;
  const double frames = double(kAll - kAveraged + 1);
  EXPECT_NEAR(alike, (1.0 - std::pow(1.0 - 1.0 / kAveraged, frames)) / frames, 1e-6);
  double total = 0.0;
  for (uint32_t s = 0; s < kAll; ++s) {
    total += weights.at(s, 0).x;
    EXPECT_LE(weights.at(s, 0).x, alike * 1.01f) << s;
    if (s + 3 * kAveraged >= kAll) continue;
    EXPECT_GE(weights.at(s, 0).x, alike * 0.94f) << s;
  }
  EXPECT_NEAR(total, 1.0, 1e-5);
}

TEST(Files, NamesAreSafe) {
  EXPECT_EQ(safeFileName("path traced (1 spp)"), "path-traced-1-spp");
  EXPECT_EQ(safeFileName("../../etc/passwd"), "unnamed..-..-etc-passwd");
  EXPECT_EQ(safeFileName(""), "unnamed");
  EXPECT_EQ(safeFileName("//"), "unnamed");
}

}  // namespace

}  // namespace restlab
