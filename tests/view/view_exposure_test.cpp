// Tests of the exposure with which a page opens.
#include "experiments/view/view_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/runner/tables/preview.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {
namespace {

// A lamp of a few pixels touches more than one block in a hundred; they must not count as lamp.
TEST(ViewExposure, OfNoiseIsThatOfThePictureBesideALamp) {
  const auto roomOf = [](double share) {
    std::mt19937 random(1);
    std::bernoulli_distribution isLit(share);
    Image image(160, 96, glm::vec3(0.0f));
    for (glm::vec3& pixel : image.pixels)
      if (isLit(random)) pixel = glm::vec3(0.1f / float(share));
    for (uint32_t x = 60; x < 100; ++x)
      for (uint32_t y = 7; y < 9; ++y) image.at(x, y) = glm::vec3(15.0f);
    return image;
  };
  const Image converged = roomOf(1.0);
  const double wanted = previewExposure(converged);
  EXPECT_GT(wanted, 1.0) << "less than a pixel in a hundred is the lamp";
  EXPECT_LT(previewExposure(blockMeans(converged, 8)), 0.5 * wanted) << "as it was";
  EXPECT_LT(previewExposure(roomOf(0.25)), 0.5 * wanted) << "and why blocks are there at all";
  for (const double share : {1.0, 0.5, 0.25})
    EXPECT_NEAR(std::log2(exposureOfNoise(roomOf(share)) / wanted), 0.0, 0.35) << share;
  EXPECT_EQ(exposureOfNoise(Image(16, 16)), 1.0f);
}

TEST(ViewExposure, OfTheFirstFrameIsNearThatOfTheReport) {
  std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path", "accumulate")};
  for (SessionConfig& pane : panes) {
    pane.width = 160;
    pane.height = 90;
  }
  LiveView view(cornellBox(), panes, {});
  EXPECT_EQ(exposureOf(view), 1.0) << "nothing is there";
  view.renderFrames();
  const double first = exposureOf(view);
  for (int i = 0; i < 32; ++i) view.refineReference();
  const double report = previewExposure(view.reference().mean());
  EXPECT_EQ(exposureOf(view), report);
  EXPECT_NEAR(std::log2(first / report), 0.0, 0.5);
}

}  // namespace
}  // namespace restlab::view_test
