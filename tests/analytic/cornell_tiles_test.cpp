// The committed tile means against the published mean and, if available, the gate's image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "tests/analytic/cornell_tiles.h"

namespace restlab::analytic {
namespace {

TEST(CornellTiles, AverageToThePublishedMean) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& tile : cornellTileMeans()) mean += tile / 64.0;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c] / kCornellMean[c], 1.0, 5e-4) << "channel " << c;
  }
}

TEST(CornellTiles, MeansOfAnImage) {
  Image image(512, 512);
  for (uint32_t y = 0; y < 512; ++y) {
    for (uint32_t x = 0; x < 512; ++x)
      image.at(x, y) = glm::vec3(float(x / 64), float(y / 64), 1.0f);
  }
  const TileMeans means = tileMeansOf(image);
  EXPECT_EQ(means[0], glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(means[3], glm::dvec3(3.0, 0.0, 1.0));
  EXPECT_EQ(means[8 * 5 + 2], glm::dvec3(2.0, 5.0, 1.0));
  EXPECT_THROW(tileMeansOf(Image(256, 512)), std::invalid_argument);
}

TEST(CornellTiles, AgreeWithTheGateImage) {
  const char* variable = std::getenv("RESTLAB_SCENES");
  const std::filesystem::path root =
      variable != nullptr ? std::filesystem::path(variable)
                          : std::filesystem::path(RESTLAB_SOURCE_DIR) / "../shared/scenes";
  const std::filesystem::path file = root / "gates/cornell-d8/reference.exr";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "gates/cornell-d8/reference.exr is absent (set RESTLAB_SCENES)";
  }
  const TileMeans theirs = tileMeansOf(readExr(file).layers.at(""));
  std::vector<double> differences;
  for (size_t i = 0; i < theirs.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      differences.push_back(std::abs(theirs[i][c] / cornellTileMeans()[i][c] - 1.0));
    }
  }
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[differences.size() / 2], 1e-3);
  EXPECT_LT(differences[differences.size() * 9 / 10], 5e-3);
  EXPECT_LT(differences.back(), 2e-2);
}

}  // namespace
}  // namespace restlab::analytic
