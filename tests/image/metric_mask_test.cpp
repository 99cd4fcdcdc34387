// Metrics over a part of the image.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/metrics/metrics.h"
#include "core/image/metrics/ssim.h"
#include "tests/image/known_pair.h"

namespace restlab {
namespace {

using image_test::KnownPair;

constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

Image cropped(const Image& image, const PixelRectangle& r) {
  Image part(r.x1 - r.x0, r.y1 - r.y0);
  for (uint32_t y = r.y0; y < r.y1; ++y) {
    for (uint32_t x = r.x0; x < r.x1; ++x) part.at(x - r.x0, y - r.y0) = image.at(x, y);
  }
  return part;
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(int(error.code()), int(ExitCode::badInput));
    return error.what();
  }
  return "";
}

TEST(MetricMask, KnownValues) {
  const KnownPair pair;
  MetricOptions options;
  options.mask = maskOfRectangles(40, 30, {{10, 5, 25, 20}});
  const auto value = [&](const char* name) {
    return evaluateMetric(name, pair.image, pair.reference, options).value;
  };
  EXPECT_NEAR(value("mse"), 0.0013885498046875, 1e-15);
  EXPECT_NEAR(value("rmse"), std::sqrt(0.0013885498046875), 1e-14);
  EXPECT_NEAR(value("mae"), 0.032262731481481483, 1e-14);
  EXPECT_NEAR(value("relmse_e1e-2"), 0.023432623201647414, 1e-14);
  EXPECT_NEAR(value("mape_mean1e-2"), 0.28295221643637847, 1e-13);
  EXPECT_NEAR(value("smape"), 0.15314313242862476, 1e-13);
  EXPECT_NEAR(value("psnr"), 28.437596892419947, 1e-11);
  EXPECT_NEAR(value("energy_ratio"), 1.0008837669683259, 1e-13);
  EXPECT_NEAR(mseAgainstHalves(pair.image, pair.reference, pair.reference, options.mask),
              0.0013885498046875, 1e-15);
}

// Metrics of single pixels give the same value with a mask as on the cropped image.
TEST(MetricMask, IsTheSameAsACropForPixelMetrics) {
  const KnownPair pair;
  const PixelRectangle part{3, 2, 38, 29};
  MetricOptions options;
  options.mask = maskOfRectangles(40, 30, {part});
  for (const MetricInfo& metric : metricRegistry()) {
    if (metric.readsNeighbours || metric.needsRuns) continue;
    const double masked = metric.function(pair.image, pair.reference, options).value;
    const double alone =
        metric.function(cropped(pair.image, part), cropped(pair.reference, part), {}).value;
    EXPECT_EQ(masked, alone) << metric.name;
  }
}

TEST(MetricMask, PicksFromTheMapOfWindowMetrics) {
  const KnownPair pair;
  MetricOptions options;
  options.mask = maskOfRectangles(40, 30, {{7, 8, 8, 9}});
  EXPECT_EQ(evaluateMetric("ssim", pair.image, pair.reference, options).value,
            ssimPerPixel(pair.image, pair.reference)[8 * 40 + 7]);
  for (const bool hdr : {false, true}) {
    const FlipExposureChoice choice = chooseFlipExposures(pair.reference);
    const std::vector<double> map =
        hdr ? flipHdrPerPixel(pair.image, pair.reference, *choice.exposures)
            : flipLdrPerPixel(pair.image, pair.reference);
    const char* name = hdr ? "flip_hdr" : "flip_ldr";
    EXPECT_EQ(evaluateMetric(name, pair.image, pair.reference, options).value, map[8 * 40 + 7]);
  }
}

TEST(MetricMask, WorstPixelIsNamedInTheImage) {
  KnownPair pair;
  pair.image.at(20, 10).z = 9.0f;
  pair.image.at(1, 1).x = 50.0f;  // outside the mask
  MetricOptions options;
  options.mask = maskOfRectangles(40, 30, {{10, 5, 25, 20}});
  EXPECT_EQ(evaluateMetric("max_err", pair.image, pair.reference, options).detail,
            "at x 20 y 10 channel B");
  EXPECT_EQ(evaluateMetric("relmse_e1e-2_trim0.1", pair.image, pair.reference, options).detail,
            "dropped 0 of 225 pixels");
}

TEST(MetricMask, BadValuesOutsideAreCountedButDoNotMatter) {
  const KnownPair good;
  KnownPair pair = good;
  MetricOptions options;
  options.mask = maskOfRectangles(40, 30, {{10, 5, 25, 20}});
  pair.image.at(0, 0).x = kNanF;
  for (const MetricInfo& metric : metricRegistry()) {
    if (metric.readsNeighbours || metric.needsRuns) continue;
    EXPECT_EQ(metric.function(pair.image, pair.reference, options).value,
              metric.function(good.image, good.reference, options).value)
        << metric.name;
  }
  const MetricValue count = evaluateMetric("nonfinite", pair.image, pair.reference, options);
  EXPECT_EQ(count.value, 0.0);
  EXPECT_EQ(count.detail, "0 in the reference, 1 of the image outside of the mask");
  pair.image.at(24, 19).y = kNanF;
  EXPECT_TRUE(std::isnan(evaluateMetric("mse", pair.image, pair.reference, options).value));
}

TEST(MetricMask, RectanglesAreUnited) {
  const PixelMask mask = maskOfRectangles(6, 4, {{0, 0, 2, 2}, {1, 1, 3, 2}, {5, 3, 6, 4}});
  const PixelMask expected = {1, 1, 0, 0, 0, 0,  //
                              1, 1, 1, 0, 0, 0,  //
                              0, 0, 0, 0, 0, 0,  //
                              0, 0, 0, 0, 0, 1};
  EXPECT_EQ(mask, expected);
  EXPECT_EQ(countSelected(mask, 24), 6u);
  EXPECT_EQ(countSelected(intersection(mask, maskOfRectangles(6, 4, {{0, 0, 1, 4}})), 24), 2u);
  EXPECT_EQ(intersection(mask, {}), mask);
}

TEST(MetricMask, OfAnImage) {
  Image image(3, 1);
  image.pixels = {glm::vec3(0), glm::vec3(0, 0, -1), glm::vec3(2)};
  EXPECT_EQ(maskOfImage(image), (PixelMask{0, 1, 1}));
  image.pixels[0].y = kNanF;
  EXPECT_NE(errorOf([&] { maskOfImage(image); }), "");
}

TEST(MetricMask, UsersErrors) {
  const KnownPair pair;
  const auto evaluate = [&](const PixelMask& mask) {
    MetricOptions options;
    options.mask = mask;
    for (const char* name : {"mse", "ssim", "nonfinite"}) {
      EXPECT_NE(errorOf([&] { evaluateMetric(name, pair.image, pair.reference, options); }), "");
    }
  };
  evaluate(PixelMask(40 * 30, 0));
  evaluate(PixelMask(40 * 30 - 1, 1));
  for (const PixelRectangle& bad :
       {PixelRectangle{0, 0, 41, 1}, {0, 0, 1, 31}, {5, 5, 5, 6}, {5, 6, 6, 5}}) {
    EXPECT_NE(errorOf([&] { maskOfRectangles(40, 30, {bad}); }).find("40"), std::string::npos);
  }
}

}  // namespace
}  // namespace restlab
