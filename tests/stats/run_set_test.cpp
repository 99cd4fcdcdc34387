// Runs and references reduced to cells, against values computed by hand.
#include "experiments/statistics/run_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace restlab::stats {
namespace {

TEST(RunSet, CellMeansAreExact) {
  // 13 x 9 pixels give blocks of unequal size.
  Image image(13, 9);
  std::mt19937 random(1);
  for (glm::vec3& pixel : image.pixels) {
    pixel = glm::vec3(float(random() % 64), float(random() % 64), float(random() % 64));
  }
  RunSet set(BlockGrid(13, 9));
  set.add(image);
  EXPECT_EQ(set.grid().side, 8u);
  double sum = 0.0, area = 0.0;
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 8; ++x) {
      const CellArea cell{x, y, 1};
      const double pixels = double(pixelCount(set.grid(), cell));
      EXPECT_GE(pixels, 1.0);
      sum += set.cellMeans(cell, Quantity::green)[0] * pixels;
      area += pixels;
    }
  }
  EXPECT_EQ(area, 117.0);
  double wanted = 0.0;
  for (const glm::vec3& pixel : image.pixels) wanted += pixel.y;
  EXPECT_NEAR(sum, wanted, 1e-9);
  EXPECT_NEAR(set.cellMeans({0, 0, 8}, Quantity::green)[0], wanted / 117.0, 1e-12);
  EXPECT_EQ(BlockGrid(5, 100).side, 4u);
  EXPECT_EQ(BlockGrid(1, 1).side, 1u);
  EXPECT_THROW(BlockGrid(0, 4), std::invalid_argument);
  EXPECT_THROW(set.add(Image(13, 8)), std::invalid_argument);
}

TEST(RunSet, QuantitiesOfAPixel) {
  // Luminance of Rec. 709 / sRGB (ITU-R BT.709 gives four digits).
  EXPECT_NEAR(quantityOf({1.0f, 0.0f, 0.0f}, Quantity::luminance), 0.2126, 5e-5);
  EXPECT_NEAR(quantityOf({0.0f, 1.0f, 0.0f}, Quantity::luminance), 0.7152, 5e-5);
  EXPECT_NEAR(quantityOf({0.0f, 0.0f, 1.0f}, Quantity::luminance), 0.0722, 5e-5);
  EXPECT_NEAR(quantityOf(glm::vec3(1.0f), Quantity::luminance), 1.0, 1e-12);
  const glm::vec3 pixel(0.25f, 2.0f, -1.0f);
  EXPECT_EQ(quantityOf(pixel, Quantity::red), 0.25);
  EXPECT_EQ(quantityOf(pixel, Quantity::green), 2.0);
  EXPECT_EQ(quantityOf(pixel, Quantity::blue), -1.0);
  const char* names[] = {"luminance", "red", "green", "blue"};
  for (uint32_t q = 0; q < kQuantities; ++q) EXPECT_STREQ(quantityName(Quantity(q)), names[q]);
}

TEST(RunSet, Skewness) {
  EXPECT_EQ(skewness({1.0, 1.0, 1.0}), 0.0);
  EXPECT_NEAR(skewness({1.0, 2.0, 3.0}), 0.0, 1e-15);
  // (0, 0, 3) has m2 = 2, m3 = 2.
  EXPECT_NEAR(skewness({0.0, 0.0, 3.0}), 2.0 / std::pow(2.0, 1.5), 1e-15);
}

// Two pixels, computed by hand.
TEST(ReferenceCells, KnownValues) {
  const auto pair = [](float a, float b) {
    Image image(2, 1);
    image.at(0, 0) = glm::vec3(a);
    image.at(1, 0) = glm::vec3(b);
    return image;
  };
  const BlockGrid grid(2, 1);
  const CellArea whole{0, 0, 1};
  // Variances of the pixels' means (a - b)^2 / 4: 1 and 1/16. The mean of both has a quarter of
  // their sum, with 3 (sum v)^2 / sum v^2 degrees of freedom.
  const Sample halves = ReferenceCells::fromHalves(grid, pair(1.0f, 2.0f), pair(3.0f, 2.5f))
                            .cell(whole, Quantity::red);
  EXPECT_NEAR(halves.mean, 2.125, 1e-15);
  EXPECT_NEAR(halves.variance / halves.n, (1.0 + 0.0625) / 4.0, 1e-12);
  EXPECT_NEAR(halves.n - 1.0, 3.0 * 1.0625 * 1.0625 / (1.0 + 0.0625 * 0.0625), 1e-12);
  // A given variance is known without error. Channels are taken as fully correlated.
  Image variance(2, 1);
  variance.at(0, 0) = {0.04f, 0.01f, 0.09f};
  variance.at(1, 0) = {0.16f, 0.0f, 0.0f};
  const ReferenceCells given = ReferenceCells::fromVariance(grid, pair(1.0f, 2.0f), variance);
  const Sample red = given.cell(whole, Quantity::red);
  EXPECT_NEAR(red.mean, 1.5, 1e-15);
  EXPECT_NEAR(red.variance / red.n, (0.04 + 0.16) / 4.0, 1e-8);
  EXPECT_GT(red.n, 1e9);
  const Sample luminance = given.cell(whole, Quantity::luminance);
  const double deviations[] = {0.2126 * 0.2 + 0.7152 * 0.1 + 0.0722 * 0.3, 0.2126 * 0.4};
  EXPECT_NEAR(luminance.variance / luminance.n,
              (deviations[0] * deviations[0] + deviations[1] * deviations[1]) / 4.0, 1e-6);
  const Sample exact = ReferenceCells::exact(grid, pair(1.0f, 2.0f)).cell(whole, Quantity::blue);
  EXPECT_EQ(exact.mean, 1.5);
  EXPECT_EQ(exact.variance, 0.0);
}

}  // namespace
}  // namespace restlab::stats
