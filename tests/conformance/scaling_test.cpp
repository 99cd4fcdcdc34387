// The renderer has no constants with units: twice the light gives twice the image, and a scaled
// scene gives the same image. For powers of two this holds to the last bit, whatever a method draws
// or stores. A constant that is compared with a radiance or a length breaks it.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/radiance_range.h"
#include "core/scene/scene.h"
#include "tests/conformance/variants.h"

namespace restlab::conformance {
namespace {

constexpr uint32_t kScaledFrames = 6;

class Scaling : public ::testing::TestWithParam<Variant> {
 protected:
  // Counts channel values that differ from those of the plain scene times 2^`power`.
  size_t differences(const std::string& scene, const std::string& relation, int power) const {
    const SessionConfig config = configOf(GetParam(), 32, 18);
    Image expected = imageOf(scene, config);
    for (glm::vec3& pixel : expected.pixels) pixel *= std::exp2(float(power));
    return countDifferent(imageOf(scene + "?" + relation, config), expected);
  }

  static const DenoiserInfo& denoiser() { return findDenoiser(GetParam().denoiser); }

  // Keeps the camera still: runFrames() moves by metres.
  static Image imageOf(const std::string& scene, const SessionConfig& config) {
    Session session(CompiledScene::build(makeBuiltinScene(scene)), config);
    for (uint32_t frame = 0; frame < kScaledFrames; ++frame) session.frame();
    return session.radiance();
  }
};

constexpr const char* kScenes[] = {"cornell-box", "glossy-gallery", "courtyard"};

TEST_P(Scaling, RadianceTimesAPowerOfTwo) {
  // Squares of radiance leave float's range earlier (docs/denoising.md). The range of another
  // library's filter is unknown.
  const int most = denoiser().comparesSquares || denoiser().onHost ? 40 : 60;
  for (const char* scene : kScenes) {
    for (const int power : {-most, most})
      EXPECT_EQ(differences(scene, "radiance=2^" + std::to_string(power), power), 0u)
          << scene << " 2^" << power;
  }
}

// Beyond its range a filter has other weights but makes nothing non-finite; only then a warning
// says so.
TEST_P(Scaling, BeyondTheirRangeFiltersStayFinite) {
  if (!denoiser().comparesSquares) GTEST_SKIP() << "no squares";
  for (const char* relation : {"radiance=2^60", "radiance=2^-60"}) {
    const Image image =
        imageOf(std::string("cornell-box?") + relation, configOf(GetParam(), 32, 18));
    for (const glm::vec3& p : image.pixels)
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << relation;
    EXPECT_NE(whyOutsideRange(denoiser(), image), "") << relation;
  }
}

TEST(RadianceRange, IsSaidOfFiltersBeyondIt) {
  const DenoiserInfo &svgf = findDenoiser("svgf"), &none = findDenoiser("none");
  const auto lineOf = [&](const DenoiserInfo& info, float radiance) {
    Image image(2, 2, glm::vec3(radiance));
    image.pixels[0] = glm::vec3(0.0f);
    return whyOutsideRange(info, image);
  };
  for (const float inside : {0.0f, 0x1p-40f, 1.0f, 0x1p40f}) EXPECT_EQ(lineOf(svgf, inside), "");
  for (const float beyond : {0x1p-41f, 0x1p41f}) {
    EXPECT_NE(lineOf(svgf, beyond).find("svgf: the mean luminance of what is lit is"),
              std::string::npos);
    EXPECT_EQ(lineOf(none, beyond), "");
  }
}

TEST_P(Scaling, ASceneOfAnotherSize) {
  for (const char* scene : kScenes) {
    for (const int power : {-13, 17})
      EXPECT_EQ(differences(scene, "scale=2^" + std::to_string(power), 0), 0u)
          << scene << " 2^" << power;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Scaling, ::testing::ValuesIn(byDay(allVariants())), VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, Scaling, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());

}  // namespace
}  // namespace restlab::conformance
