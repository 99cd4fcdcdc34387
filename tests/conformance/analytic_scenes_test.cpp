// Scenes with an exact solution: the furnaces and the floor under the tilted rectangle.
#include <gtest/gtest.h>

#include "core/image/metrics/metrics.h"
#include "experiments/truths/truths.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

Image exact(const Scene& scene, uint32_t width, uint32_t height, uint32_t scatteringEvents) {
  Image image(width, height);
  const std::vector<glm::dvec3> truth = analytic::exactImage(
      scene, {.width = width, .height = height, .scatteringEvents = scatteringEvents});
  for (size_t p = 0; p < truth.size(); ++p) image.pixels[p] = glm::vec3(truth[p]);
  return image;
}

// Share of the image's area that is too skewed for a t-test.
double skewedShare(const stats::BiasReport& report, const stats::BlockGrid& grid) {
  double pixels = 0.0;
  for (const stats::CellVerdict& v : report.cells) {
    const bool counts = !v.wholeImage && v.quantity == report.cells.front().quantity;
    if (counts && v.whyNot == "skewed") pixels += double(stats::pixelCount(grid, v.area));
  }
  return pixels / (double(grid.width) * double(grid.height));
}

class Analytic : public ::testing::TestWithParam<Variant> {
 protected:
  // Checks unbiased modes by t-tests per cell, and modes declared biased by the bound for published
  // rows: an energy within 5 %. Cells without any noise must be equal.
  void expectExact(const std::string& sceneName, uint32_t maxBounces, bool roulette = false) {
    const auto scene = bias::builtinScene(sceneName);
    bias::Method method = methodOf(GetParam(), 8, 2);
    method.name += ", " + std::to_string(maxBounces) + " scattering events";
    method.config.maxBounces = maxBounces;
    method.config.russianRoulette = roulette;
    if (roulette) method.name += ", Russian roulette";
    const Image truth =
        exact(scene->source(), method.config.width, method.config.height, maxBounces);
    const stats::BlockGrid grid(truth.width, truth.height);
    stats::BiasOptions options;
    options.quantities = {stats::Quantity::red, stats::Quantity::green, stats::Quantity::blue};
    const stats::BiasReport report = bias::testMethod(
        scene, method, stats::truthOf(stats::ReferenceCells::exact(grid, truth)), 128, options);
    EXPECT_EQ(report.nonfinite, 0u);
    if (GetParam().bias == BiasClass::unbiased) {
      EXPECT_EQ(report.confirmed, 0u) << report.text();
    }
    for (const stats::CellVerdict& v : report.cells) {
      if (v.wholeImage || GetParam().bias != BiasClass::unbiased) {
        EXPECT_NEAR(v.mean / v.reference, 1.0, v.wholeImage ? 0.05 : 0.2) << method.name;
      }
      EXPECT_TRUE(v.testable || v.equal || v.whyNot == "skewed") << v.whyNot;
    }
    EXPECT_LT(skewedShare(report, grid), 0.5) << report.text();
  }
};

TEST_P(Analytic, FurnaceAfterEveryNumberOfEvents) {
  for (const uint32_t events : {1u, 8u}) expectExact("furnace", events);
}

TEST_P(Analytic, FurnaceUnderRussianRoulette) { expectExact("furnace", 8, true); }

TEST_P(Analytic, FurnaceWithoutScatteringIsItsEmission) {
  SessionConfig config = configOf(GetParam());
  config.maxBounces = 0;
  const Image image = render(bias::builtinScene("furnace"), config, 3);
  EXPECT_EQ(countDifferent(image, Image(config.width, config.height, glm::vec3(0.5f))), 0u);
}

TEST_P(Analytic, SphereFurnace) {
  for (const uint32_t events : {1u, 8u}) expectExact("sphere-furnace", events);
}

TEST_P(Analytic, FloorUnderATiltedRectangle) {
  for (const uint32_t events : {1u, 8u}) expectExact("quad-light", events);
}

// Filters are left out: tests/denoise/energy_test.cpp checks them on whole images, and single cells
// have no bound.
std::vector<Variant> variantsWithoutFilters() {
  std::vector<Variant> all = allVariants();
  std::erase_if(all, [](const Variant& v) { return v.blurs() || v.leavesLightOut(); });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, Analytic, ::testing::ValuesIn(meansByDay(variantsWithoutFilters())),
                         VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, Analytic,
                         ::testing::ValuesIn(meansByNight(variantsWithoutFilters())),
                         VariantName());

}  // namespace
}  // namespace restlab::conformance
