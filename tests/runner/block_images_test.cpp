// Exposure of pictures: the log average of blocks, and a bright end of pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "experiments/runner/tables/preview.h"

namespace restlab {

namespace {

TEST(PreviewExposure, MakesTheMeanOfWhatIsLitMidGrey) {
  Image image(64, 32, glm::vec3(2.0f));
  EXPECT_NEAR(previewExposure(image), 0.09f, 1e-6f);
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t x = 0; x < 32; ++x) image.at(x, y) = glm::vec3(0.0f);
  EXPECT_NEAR(previewExposure(image), 0.09f, 1e-6f) << "black does not brighten it";
  image.at(40, 12) = glm::vec3(64.0f * 2e3f);
  EXPECT_NEAR(previewExposure(image), 0.09 / std::pow(1e3, 1.0 / 16.0), 1e-3)
      << "a lamp hardly darkens it: one of 16 blocks";
  image.at(50, 20).x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(previewExposure(image), 0.09 / std::pow(1e3, 1.0 / 16.0), 1e-3) << "does not count";
  EXPECT_EQ(previewExposure(Image(4, 4)), 1.0f);
  const float usual = previewExposure(image);
  for (const float factor : {0x1p-60f, 0x1p60f}) {
    Image scaled = image;
    for (glm::vec3& pixel : scaled.pixels) pixel *= factor;
    EXPECT_NEAR(previewExposure(scaled) * factor / usual, 1.0f, 1e-5f) << "no absolute constant";
  }
}

// A lamp of a few pixels touches more than one block in a hundred, but is less than one pixel in a
// hundred. Fewer samples leave pixels black and make the others brighter.
TEST(PreviewExposure, OfNoiseIsThatOfThePictureBesideALamp) {
  const auto roomOf = [](double share, uint32_t lampHeight) {
    std::mt19937 random(1);
    std::bernoulli_distribution isLit(share);
    Image image(160, 96, glm::vec3(0.0f));
    for (glm::vec3& pixel : image.pixels)
      if (isLit(random)) pixel = glm::vec3(0.1f / float(share));
    for (uint32_t x = 60; x < 100; ++x)
      for (uint32_t y = 7; y < 7 + lampHeight; ++y) image.at(x, y) = glm::vec3(15.0f);
    return image;
  };
  const double wanted = previewExposure(roomOf(1.0, 2));
  EXPECT_GT(wanted, 1.0) << "less than a pixel in a hundred is the lamp";
  for (const double share : {0.5, 0.25, 0.06, 0.02})
    EXPECT_NEAR(std::log2(previewExposure(roomOf(share, 2)) / wanted), 0.0, 0.35) << share;
  EXPECT_LT(previewExposure(roomOf(1.0, 8)), 0.5 * wanted) << "more of it than may be clipped";
}

}  // namespace

}  // namespace restlab
