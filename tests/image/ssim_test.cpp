// SSIM against the paper's formula in NumPy, window by window.
#include "core/image/metrics/ssim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/image/metrics/metrics.h"
#include "tests/image/known_pair.h"

namespace restlab {
namespace {

TEST(Ssim, AgreesWithTheFormulaInNumPy) {
  const image_test::RoughPair pair(1.5f);  // a third of the values is clipped
  const std::vector<double> map = ssimPerPixel(pair.image, pair.reference);
  EXPECT_NEAR(map[0], 0.960283945430, 1e-11);
  EXPECT_NEAR(map[64 * 20 + 7], 0.858463935640, 1e-11);
  EXPECT_NEAR(map[149 * 20 + 19], 0.943391375583, 1e-11);
  const MetricValue value = evaluateMetric("ssim", pair.image, pair.reference);
  EXPECT_NEAR(value.value, 0.876645461561, 1e-11);
  EXPECT_NE(value.detail.find("clipped"), std::string::npos) << value.detail;
  EXPECT_EQ(map, ssimPerPixel(pair.reference, pair.image)) << "symmetric";
}

// Without variance only the luminance term remains, of the sRGB values.
TEST(Ssim, ConstantsByFormula) {
  const Image reference(16, 9, glm::vec3(0.5f)), image(16, 9, glm::vec3(0.4f));
  EXPECT_NEAR(evaluateMetric("ssim", image, reference).value, 0.994992383076619, 1e-7);
  const Image white(16, 9, glm::vec3(1.0f)), black(16, 9);
  EXPECT_NEAR(evaluateMetric("ssim", black, white).value, 1e-4 / (1.0 + 1e-4), 1e-12);
}

TEST(Ssim, EveryChannelCounts) {
  image_test::RoughPair pair;
  const double before = evaluateMetric("ssim", pair.reference, pair.reference).value;
  EXPECT_NEAR(before, 1.0, 1e-12);
  for (int c = 0; c < 3; ++c) {
    Image image = pair.reference;
    for (glm::vec3& pixel : image.pixels) pixel[c] = 1.0f - pixel[c];
    EXPECT_LT(evaluateMetric("ssim", image, pair.reference).value, 0.9) << c;
  }
}

TEST(Ssim, SmallerThanItsWindow) {
  const Image reference(2, 1, glm::vec3(0.5f)), image(2, 1, glm::vec3(0.4f));
  EXPECT_NEAR(evaluateMetric("ssim", image, reference).value, 0.994992383076619, 1e-7);
}

TEST(Ssim, NanIsNotClampedAway) {
  image_test::RoughPair pair;
  pair.image.at(3, 70).x = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> map = ssimPerPixel(pair.image, pair.reference);
  EXPECT_TRUE(std::isnan(map[70 * 20 + 3]));
  EXPECT_TRUE(std::isnan(map[66 * 20 + 3])) << "across a band of rows";
  EXPECT_FALSE(std::isnan(map[70 * 20 + 12]));
  EXPECT_TRUE(std::isnan(evaluateMetric("ssim", pair.image, pair.reference).value));
}

}  // namespace
}  // namespace restlab
