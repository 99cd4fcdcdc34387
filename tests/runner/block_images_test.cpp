// Exposure of the preview images of a block.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/tables/preview.h"

namespace restlab {

namespace {

TEST(PreviewExposure, MakesTheMeanOfWhatIsLitMidGrey) {
  Image image(4, 4, glm::vec3(2.0f));
  EXPECT_NEAR(previewExposure(image), 0.09f, 1e-6f);
  for (size_t i = 0; i < 8; ++i) image.pixels[i] = glm::vec3(0.0f);
  EXPECT_NEAR(previewExposure(image), 0.09f, 1e-6f) << "black does not brighten it";
  image.pixels[15] = glm::vec3(2e6f);
  EXPECT_NEAR(previewExposure(image), 0.09 / std::pow(1e6, 1.0 / 8.0), 1e-4)
      << "a lamp hardly darkens it";
  EXPECT_EQ(previewExposure(Image(4, 4)), 1.0f);
  const float usual = previewExposure(image);
  for (const float factor : {0x1p-60f, 0x1p60f}) {
    Image scaled = image;
    for (glm::vec3& pixel : scaled.pixels) pixel *= factor;
    EXPECT_NEAR(previewExposure(scaled) * factor / usual, 1.0f, 1e-5f) << "no absolute constant";
  }
}

}  // namespace

}  // namespace restlab
