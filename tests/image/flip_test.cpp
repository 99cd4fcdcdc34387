// FLIP against known answers of the authors' implementation, against the papers' formulas in NumPy
// (two-dimensional kernels, double precision), and in cases where other implementations fail.
#include "core/image/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/image/metrics/flip_color.h"
#include "core/image/metrics/metrics.h"
#include "tests/image/known_pair.h"

namespace restlab {
namespace {

constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

template <class F>
Image square64(F f) {
  Image image(64, 64);
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) image.at(x, y) = f(x, y);
  }
  return image;
}

Image ramp(float red, float green, float blue) {
  return square64([=](uint32_t x, uint32_t y) {
    return glm::vec3(red * float(x) / 63.0f, green * float(y) / 63.0f, blue);
  });
}

Image checker(uint32_t shift) {
  return square64([=](uint32_t x, uint32_t y) {
    return glm::vec3(((x + shift) / 8 + y / 8) % 2 == 1 ? 0.8f : 0.2f);
  });
}

double meanOf(const std::vector<double>& map) {
  double sum = 0.0;
  for (const double value : map) sum += value;
  return sum / double(map.size());
}

// Mean and the values of pixels (5, 9) and (31, 31).
struct Answer {
  double mean, at5x9, at31x31;
};

void expectAnswer(const std::vector<double>& map, const Answer& known, const Answer& bounds) {
  ASSERT_EQ(map.size(), 64u * 64u);
  EXPECT_NEAR(meanOf(map), known.mean, bounds.mean);
  EXPECT_NEAR(map[9 * 64 + 5], known.at5x9, bounds.at5x9);
  EXPECT_NEAR(map[31 * 64 + 31], known.at31x31, bounds.at31x31);
}

TEST(Flip, KnownAnswersLdr) {
  EXPECT_NEAR(kFlipPixelsPerDegree, 67.0206, 5e-5);
  expectAnswer(flipLdrPerPixel(ramp(0.9f, 1.0f, 0.30f), ramp(1.0f, 1.0f, 0.25f)),
               {0.2054918, 0.1439545, 0.2064883}, {3e-7, 3e-7, 3e-7});
}

// If an edge or point is equally strong in both images, its error is the root of a rounding error:
// 2.5e-8 in single precision, which the authors used, becomes 1.3e-4 in the exponent. The test
// therefore has two rows of answers: the authors' with wide bounds (their mean of a constant even
// differs from its pixels), and NumPy's in double precision.
TEST(Flip, KnownAnswersLdrOfEqualFeatures) {
  const Image grey4(64, 64, glm::vec3(0.4f)), grey5(64, 64, glm::vec3(0.5f));
  const std::vector<double> flat = flipLdrPerPixel(grey4, grey5);
  expectAnswer(flat, {0.2156416, 0.2156506, 0.2156506}, {6e-5, 6e-5, 6e-5});
  expectAnswer(flat, {0.2155923, 0.2155923, 0.2155923}, {2e-7, 2e-7, 2e-7});
  const std::vector<double> shifted = flipLdrPerPixel(checker(1), checker(0));
  expectAnswer(shifted, {0.1952476, 0.1337397, 0.1896075}, {1.1e-5, 2e-6, 1.3e-4});
  expectAnswer(shifted, {0.1952374, 0.1337380, 0.1894881}, {2e-7, 2e-7, 2e-7});
}

TEST(Flip, KnownAnswersHdr) {
  const Image reference = ramp(4.0f, 2.0f, 0.25f), image = ramp(3.6f, 2.0f, 0.30f);
  expectAnswer(flipHdrPerPixel(image, reference, {-2.0, 2.0, 5}), {0.1980876, 0.1864651, 0.2001293},
               {3e-7, 3e-7, 1e-6});
  const FlipExposureChoice choice = chooseFlipExposures(reference);
  ASSERT_TRUE(choice.exposures);
  EXPECT_EQ(choice.note, "");
  EXPECT_EQ(choice.exposures->count, 2u);
  EXPECT_NEAR(choice.exposures->start, -0.117615, 2e-6);
  EXPECT_NEAR(choice.exposures->stop, 0.870714, 2e-6);
  expectAnswer(flipHdrPerPixel(image, reference, *choice.exposures),
               {0.1964911, 0.1887897, 0.1988290}, {3e-7, 3e-7, 1.5e-6});
}

// An image that is not square, has borders close by, and is taller than a band of rows.
TEST(Flip, AgreesWithTheFormulasInNumPy) {
  const image_test::RoughPair pair;
  const auto at = [](const std::vector<double>& map, size_t x, size_t y) {
    return map[y * 20 + x];
  };
  const std::vector<double> far = flipLdrPerPixel(pair.image, pair.reference);
  EXPECT_NEAR(meanOf(far), 0.1331201292, 1e-9);
  EXPECT_NEAR(at(far, 0, 0), 0.1619071990, 1e-9);
  EXPECT_NEAR(at(far, 7, 64), 0.2727683229, 1e-9);
  EXPECT_NEAR(at(far, 19, 149), 0.1346592342, 1e-9);
  const std::vector<double> near = flipLdrPerPixel(pair.image, pair.reference, 30.0);
  EXPECT_NEAR(meanOf(near), 0.2910473322, 1e-9);
  EXPECT_NEAR(at(near, 7, 64), 0.1593097023, 1e-9);
  const image_test::RoughPair bright(8.0f);
  const std::vector<double> hdr = flipHdrPerPixel(bright.image, bright.reference, {-3.0, 1.0, 3});
  EXPECT_NEAR(meanOf(hdr), 0.2048302572, 1e-9);
  EXPECT_NEAR(at(hdr, 7, 64), 0.2739536513, 1e-9);
}

// LDR FLIP is symmetric in image and reference.
TEST(Flip, IsSymmetricAndWithinBounds) {
  const image_test::RoughPair pair;
  const std::vector<double> map = flipLdrPerPixel(pair.image, pair.reference);
  EXPECT_EQ(map, flipLdrPerPixel(pair.reference, pair.image));
  for (const double value : map) {
    ASSERT_GE(value, 0.0);
    ASSERT_LE(value, 1.0);
  }
  // Largest possible difference, without edges that could raise it.
  const Image green(32, 32, glm::vec3(0, 1, 0)), blue(32, 32, glm::vec3(0, 0, 1));
  EXPECT_NEAR(meanOf(flipLdrPerPixel(green, blue)), 1.0, 1e-9);
}

// Trap: a clamp turns a NaN into black and leaves the mean unchanged.
TEST(Flip, NanPixelIsNotClampedAway) {
  const Image reference = ramp(1.0f, 1.0f, 0.25f);
  for (const bool inReference : {false, true}) {
    Image image = ramp(0.9f, 1.0f, 0.25f), other = reference;
    (inReference ? other : image).at(20, 40).y = kNanF;
    // Bypass the registry's check: the filters themselves must propagate the NaN.
    const std::vector<double> ldr = flipLdrPerPixel(image, other);
    const std::vector<double> hdr = flipHdrPerPixel(image, other, {-1.0, 1.0, 3});
    for (const auto& map : {ldr, hdr}) {
      EXPECT_TRUE(std::isnan(map[40 * 64 + 20]));
      EXPECT_TRUE(std::isnan(map[43 * 64 + 18])) << "within the filters' reach";
      EXPECT_FALSE(std::isnan(map[40 * 64 + 50])) << "beyond it";
      EXPECT_TRUE(std::isnan(meanOf(map)));
    }
    for (const char* name : {"flip_ldr", "flip_hdr"}) {
      const MetricValue value = evaluateMetric(name, image, other);
      EXPECT_TRUE(std::isnan(value.value)) << name;
      EXPECT_NE(value.detail.find(inReference ? "1 in the reference" : "1 non-finite"),
                std::string::npos)
          << value.detail;
      // The NaN lies in the filter neighbourhood, so a mask does not hide it.
      MetricOptions options;
      options.mask = maskOfRectangles(64, 64, {{0, 0, 4, 4}});
      EXPECT_TRUE(std::isnan(evaluateMetric(name, image, other, options).value)) << name;
    }
  }
}

// Trap: a median of 0 gives infinitely many exposures, and an empty loop over them gives 0, a
// perfect score.
TEST(Flip, MostlyBlackReferenceHasExposures) {
  Image reference(32, 32), image = reference;
  for (uint32_t x = 0; x < 32; ++x) {
    reference.at(x, 3) = glm::vec3(x < 16 ? 4.0f : 1.0f);
    image.at(x, 3) = glm::vec3(0.25f);
  }
  const FlipExposureChoice choice = chooseFlipExposures(reference);
  ASSERT_TRUE(choice.exposures);
  EXPECT_EQ(choice.exposures->count, 2u);
  EXPECT_NEAR(choice.exposures->stop - choice.exposures->start, 0.0, 1e-9)
      << "of 16 and 16 lit pixels, the upper median is the maximum";
  EXPECT_NE(choice.note.find("32 of 1024 pixels"), std::string::npos) << choice.note;
  const MetricValue value = evaluateMetric("flip_hdr", image, reference);
  EXPECT_GT(value.value, 0.01);
  EXPECT_NE(value.detail.find("32 of 1024 pixels"), std::string::npos) << value.detail;
}

TEST(Flip, BlackReferenceIsNoPerfectScore) {
  const Image black(16, 16), grey(16, 16, glm::vec3(0.5f));
  const MetricValue value = evaluateMetric("flip_hdr", grey, black);
  EXPECT_TRUE(std::isnan(value.value));
  EXPECT_NE(value.detail.find("no light"), std::string::npos) << value.detail;
  MetricOptions options;
  options.flip.exposures = FlipExposures{0.0, 0.0, 1};
  EXPECT_GT(evaluateMetric("flip_hdr", grey, black, options).value, 0.1);
  EXPECT_GT(evaluateMetric("flip_ldr", grey, black).value, 0.1);
  // A range of 100 stops must not take minutes either.
  Image wide(16, 16, glm::vec3(1e-30f));
  wide.at(0, 0) = glm::vec3(1.0f);
  EXPECT_FALSE(chooseFlipExposures(wide).exposures);
}

// Trap: values above 1 are clipped, and the number is still called FLIP.
TEST(Flip, SaysWhatItClips) {
  const Image reference(16, 16, glm::vec3(3.0f)), image(16, 16, glm::vec3(6.0f));
  const MetricValue ldr = evaluateMetric("flip_ldr", image, reference);
  EXPECT_EQ(ldr.value, 0.0) << "both are white on a screen";
  EXPECT_NE(ldr.detail.find("768 channel values of the image and 768 of the reference"),
            std::string::npos)
      << ldr.detail;
  EXPECT_GT(evaluateMetric("flip_hdr", image, reference).value, 0.02) << "but differ in radiance";
}

TEST(Flip, RecordsHowItWasComputed) {
  const image_test::RoughPair pair;
  MetricOptions options;
  options.flip.pixelsPerDegree = 30.0;
  options.flip.exposures = FlipExposures{-1.0, 2.0, 4};
  const std::string detail = evaluateMetric("flip_hdr", pair.image, pair.reference, options).detail;
  for (const char* part : {"30 pixels per degree", "ACES", "4 exposures", "2^-1.0", "2^2.0"}) {
    EXPECT_NE(detail.find(part), std::string::npos) << detail;
  }
  EXPECT_NEAR(evaluateMetric("flip_ldr", pair.image, pair.reference, options).value, 0.2910473322,
              1e-9);
}

// ACES' polynomials are positive for negative radiance, which would shine.
TEST(Flip, NegativeRadianceIsBlack) {
  EXPECT_EQ(flip::toneMap(-2.0), 0.0);
  EXPECT_TRUE(std::isnan(flip::toneMap(std::nan(""))));
  EXPECT_EQ(flip::toneMap(1e30), 1.0);
  EXPECT_NEAR(flip::toneMap(flip::radianceShownAs(0.85)), 0.85, 1e-12);
  const Image reference(16, 16, glm::vec3(0.5f));
  Image image = reference;
  image.at(8, 8) = glm::vec3(-2.0f);
  const MetricValue value = evaluateMetric("flip_hdr", image, reference);
  EXPECT_NE(value.detail.find("3 channel values of the image and 0"), std::string::npos)
      << value.detail;
  Image black = reference;
  black.at(8, 8) = glm::vec3(0.0f);
  EXPECT_EQ(value.value, evaluateMetric("flip_hdr", black, reference).value);
}

TEST(Flip, ColoursGoThereAndBack) {
  const glm::dvec3 white = flip::opponentFromLinear({1, 1, 1});
  EXPECT_NEAR(white.x, 100.0, 1e-9);
  EXPECT_NEAR(white.y, 0.0, 1e-9);
  EXPECT_NEAR(white.z, 0.0, 1e-9);
  const glm::dvec3 color(0.2, 0.7, 0.4);
  const glm::dvec3 back = flip::linearFromOpponent(flip::opponentFromLinear(color));
  EXPECT_NEAR(glm::length(back - color), 0.0, 1e-12);
}

}  // namespace
}  // namespace restlab
