// Defects found in measuring code of this field, each with the metric that reveals it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/image/metrics/metrics.h"
#include "core/image/metrics/pixel_metrics.h"
#include "tests/image/known_pair.h"

namespace restlab {
namespace {

using image_test::KnownPair;

double value(const std::string& name, const Image& image, const Image& reference) {
  return evaluateMetric(name, image, reference).value;
}

Image constant(float x) { return Image(4, 4, glm::vec3(x)); }

// Defect: "mae" that squares, "rmse" that is relative or without the root.
TEST(MetricTraps, NamesSayWhatIsComputed) {
  EXPECT_NEAR(value("mae", constant(3.5f), constant(3.0f)), 0.5, 1e-12);
  EXPECT_NEAR(value("mse", constant(3.5f), constant(3.0f)), 0.25, 1e-12);
  EXPECT_NEAR(value("rmse", constant(3.5f), constant(3.0f)), 0.5, 1e-12);
  // Defect: a relative error whose denominator is not squared.
  EXPECT_NEAR(value("relmse_e1e-2", constant(3.5f), constant(3.0f)), 0.25 / 9.01, 1e-12);
}

// Defect: the first image in the denominator.
TEST(MetricTraps, TheReferenceIsTheDenominator) {
  for (const std::string name :
       {"relmse_e1e-2", "relmse_e1e-2_trim0.1", "relmse_tev", "relmse_siio"}) {
    EXPECT_NEAR(value(name, constant(1.0f), constant(2.0f)), 1.0 / 4.01, 1e-12) << name;
    EXPECT_NEAR(value(name, constant(2.0f), constant(1.0f)), 1.0 / 1.01, 1e-12) << name;
  }
  EXPECT_NEAR(value("mape_e1e-2", constant(1.0f), constant(2.0f)), 1.0 / 2.01, 1e-12);
  EXPECT_NEAR(value("energy_ratio", constant(1.0f), constant(2.0f)), 0.5, 1e-12);
  // Metrics without a denominator must be symmetric.
  const KnownPair pair;
  for (const char* name : {"mse", "rmse", "mae", "smape", "ssim", "flip_ldr", "max_err"}) {
    EXPECT_EQ(value(name, pair.image, pair.reference), value(name, pair.reference, pair.image))
        << name;
  }
}

// Defect: loading or measuring through a display, where everything above 1 is the same white.
TEST(MetricTraps, RadianceIsNotClamped) {
  EXPECT_NEAR(value("mse", constant(50.0f), constant(40.0f)), 100.0, 1e-9);
  EXPECT_NEAR(value("mae", constant(-2.0f), constant(-1.0f)), 1.0, 1e-12);
  EXPECT_NEAR(value("psnr", constant(50.0f), constant(40.0f)), 20.0 * std::log10(4.0), 1e-9);
}

// Defect: a mean over N - 1, or one larger than the maximum.
TEST(MetricTraps, MeansAreOverAllValues) {
  Image reference(1, 1, glm::vec3(1.0f)), image(1, 1, glm::vec3(1.0f));
  image.at(0, 0).x = 4.0f;
  EXPECT_NEAR(value("mae", image, reference), 1.0, 1e-12);
  EXPECT_NEAR(value("mse", image, reference), 3.0, 1e-12);
  const KnownPair pair;
  EXPECT_LE(value("mae", pair.image, pair.reference), value("max_err", pair.image, pair.reference));
}

// Defect: black pixels of the reference are left out, so a bright image of a black reference is
// perfect.
TEST(MetricTraps, BlackReferencePixelsCount) {
  const Image grey = constant(0.5f), black = constant(0.0f);
  EXPECT_NEAR(value("relmse_e1e-2", grey, black), 25.0, 1e-12);
  EXPECT_NEAR(value("relmse_pbrt", grey, black), 2500.0, 1e-9);
  EXPECT_NEAR(value("relmse_tev", grey, black), 25.0, 1e-12);
  EXPECT_NEAR(value("relmse_jeri", grey, black), 2500.0, 1e-9);
  EXPECT_NEAR(value("mape_e1e-2", grey, black), 50.0, 1e-12);
  // relmse_siio, the only convention that leaves them out, reports it.
  const MetricValue siio = evaluateMetric("relmse_siio", grey, black);
  EXPECT_EQ(siio.value, 0.0);
  EXPECT_EQ(siio.detail, "48 of 48 channel values have r = 0 and count as 0");
  // Metrics relative to the mean are undefined for a mean of 0.
  for (const char* name : {"relmse_mean2", "mape_mean1e-2"}) {
    const MetricValue none = evaluateMetric(name, grey, black);
    EXPECT_TRUE(std::isnan(none.value)) << name;
    EXPECT_NE(none.detail.find("not positive"), std::string::npos) << none.detail;
  }
}

// Defect: infinite errors are skipped, so the worse the image, the better its mean.
TEST(MetricTraps, InfiniteErrorsAreNotSkipped) {
  Image image = constant(0.5f);
  image.at(1, 1).x = std::numeric_limits<float>::infinity();
  for (const MetricInfo& metric : metricRegistry()) {
    const double result = metric.function(image, constant(0.5f), {}).value;
    if (metric.name == "nonfinite") {
      EXPECT_EQ(result, 1.0);
    } else {
      EXPECT_TRUE(std::isnan(result)) << metric.name << " " << result;
    }
  }
  // A finite error may be arbitrarily large.
  image.at(1, 1).x = 3e38f;
  EXPECT_GT(value("mse", image, constant(0.5f)), 1e75);
}

// Defect: sums in single precision lose most of 1e6 small terms after a large one.
TEST(MetricTraps, SumsAreDoubles) {
  Image reference(1024, 1024), image(1024, 1024, glm::vec3(0.01f));
  image.at(0, 0) = glm::vec3(512.0f);
  const double pixels = 1024.0 * 1024.0, small = double(0.01f);
  EXPECT_NEAR(value("mae", image, reference), (512.0 + small * (pixels - 1.0)) / pixels, 1e-12);
  EXPECT_NEAR(value("mse", image, reference),
              (512.0 * 512.0 + small * small * (pixels - 1.0)) / pixels, 1e-10);
}

TEST(MetricTraps, ConventionsOfRelativeErrors) {
  const KnownPair pair;
  const auto known = [&](const char* name) { return value(name, pair.image, pair.reference); };
  EXPECT_NEAR(known("relmse_pbrt"), 0.29060905801748471, 1e-13);
  EXPECT_NEAR(known("relmse_tev"), 0.021182849602953628, 1e-14);
  EXPECT_NEAR(known("relmse_jeri"), 0.33133749928853451, 1e-13);
  EXPECT_NEAR(known("relmse_siio"), 0.018964391215366826, 1e-14);
  EXPECT_NEAR(known("relmse_mean2"), 0.046603168221311851, 1e-14);
  EXPECT_NEAR(known("mape_mean1e-2"), 0.24034423440569586, 1e-13);
  EXPECT_EQ(evaluateMetric("relmse_siio", pair.image, pair.reference).detail,
            "55 of 3600 channel values have r = 0 and count as 0");
  for (const std::string& name : relmseConventions()) {
    EXPECT_EQ(findMetric("relmse_" + name).name, "relmse_" + name);
  }
}

// Scaling does not change metrics relative to the reference's own mean.
TEST(MetricTraps, MeanRelativeErrorsHaveNoScale) {
  KnownPair pair, brighter;
  for (Image* image : {&brighter.image, &brighter.reference}) {
    for (glm::vec3& pixel : image->pixels) pixel *= 64.0f;
  }
  for (const char* name : {"relmse_mean2", "mape_mean1e-2", "energy_ratio", "psnr"}) {
    const double before = value(name, pair.image, pair.reference);
    EXPECT_NEAR(value(name, brighter.image, brighter.reference), before, 1e-12 * before) << name;
  }
  EXPECT_GT(value("relmse_e1e-2", brighter.image, brighter.reference),
            2.0 * value("relmse_e1e-2", pair.image, pair.reference));
}

// Lost light must show: a relative error may prefer the image that clamps.
TEST(MetricTraps, LostEnergyShows) {
  const KnownPair pair;
  Image dark = pair.reference;
  for (glm::vec3& pixel : dark.pixels) pixel *= 0.6f;
  EXPECT_NEAR(value("energy_ratio", dark, pair.reference), 0.6, 1e-6);
}

}  // namespace
}  // namespace restlab
