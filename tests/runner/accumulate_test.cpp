// Sums of frames: mean and variance of the mean of known samples.
#include "experiments/statistics/block_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/runner/base/files.h"

namespace restlab {

namespace {

Image constant(float value) { return Image(2, 1, glm::vec3(value, 2.0f * value, 0.0f)); }

TEST(BlockSum, MeanOfBothWeighsBySamples) {
  BlockSum a(4), b(4);
  a.add(constant(1.0f));
  a.add(constant(2.0f));
  b.add(constant(6.0f));
  EXPECT_EQ(a.mean().at(1, 0), glm::vec3(1.5f, 3.0f, 0.0f));
  EXPECT_EQ(BlockSum::meanOfBoth(a, b).at(0, 0), glm::vec3(3.0f, 6.0f, 0.0f));
  EXPECT_EQ(BlockSum::meanOfBoth(a, BlockSum(4)).at(0, 0), glm::vec3(1.5f, 3.0f, 0.0f));
}

// The same with blocks that are complete, open, or both.
TEST(BlockSum, VarianceOfTheMean) {
  for (const uint64_t block : {1, 2, 3, 8}) {
    BlockSum a(block), b(block), squares(block);
    for (const float value : {1.0f, 2.0f}) a.add(constant(value));
    for (const float value : {3.0f, 4.0f}) b.add(constant(value));
    for (const float value : {1.0f, 3.0f, 2.0f, 4.0f}) squares.addSquares(constant(value));
    // Samples 1 2 3 4: variance 5/3, variance of the mean 5/12.
    const Image variance = BlockSum::varianceOfMean(a, b, squares);
    EXPECT_NEAR(variance.at(0, 0).x, 5.0 / 12.0, 1e-6);
    EXPECT_NEAR(variance.at(0, 0).y, 4.0 * 5.0 / 12.0, 1e-6);
    EXPECT_EQ(variance.at(0, 0).z, 0.0f);
  }
}

// One by one, in blocks made elsewhere, and restored in the middle of a block: the same bits, which
// are not those of a sum without blocks.
TEST(BlockSum, BlocksMadeElsewhereGiveTheSameBits) {
  const auto frame = [](int i) { return constant((i % 3 == 0 ? 1e7f : 1e-7f) / float(i)); };
  BlockSum whole(64), merged(64), restored(64);
  ImageSum plain, block;
  for (int i = 1; i <= 1000; ++i) {
    whole.add(frame(i));
    plain.add(frame(i));
    block.add(frame(i));
    if (i % 64 == 0 || i == 1000) merged.addBlock(std::exchange(block, ImageSum()));
    if (i % 100 == 50) restored = BlockSum(64, restored.blocks(), restored.open());
    restored.add(frame(i));
  }
  EXPECT_EQ(whole.blocks().count(), 960u);
  EXPECT_EQ(whole.count(), 1000u);
  for (const BlockSum* other : {&merged, &restored}) {
    EXPECT_EQ(other->blocks().sums(), whole.blocks().sums());
    EXPECT_EQ(other->open().sums(), whole.open().sums());
    EXPECT_EQ(other->mean().pixels, whole.mean().pixels);
  }
  EXPECT_NE(whole.blocks().sums()[0].x + whole.open().sums()[0].x, plain.sums()[0].x);
  EXPECT_NEAR(whole.mean().at(0, 0).x, plain.mean().at(0, 0).x, 1e-2);
}

// Up to one block it is the plain sum.
TEST(BlockSum, OneBlockIsASumOneByOne) {
  BlockSum sum(5);
  ImageSum plain;
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(sum.bytesPerPixel(), i == 1 ? 0 : sizeof(glm::dvec3));
    sum.add(constant(0.1f * float(i)));
    plain.add(constant(0.1f * float(i)));
    EXPECT_EQ(sum.onlyBlock().sums(), plain.sums());
  }
  sum.add(constant(1.0f));
  EXPECT_EQ(sum.bytesPerPixel(), 2 * sizeof(glm::dvec3));
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
