// restlab reference: halves, variance, and the three ways to stop.
#include <cmath>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

using ReferenceTest = ProgramTest;

TEST_F(ReferenceTest, HalvesAndVarianceBelongToTheMean) {
  const ProgramResult result =
      run("reference quad-light -o ref.exr --resolution 64x64 --spp 65 --seed 2 --max-bounces 1");
  ASSERT_EQ(result.code, 0) << result.err;
  const LayeredImage reference = readExr(path("ref.exr"));
  const Image &mean = reference.layers.at(""), &half0 = reference.layers.at("half0"),
              &half1 = reference.layers.at("half1"), &variance = reference.layers.at("variance");
  EXPECT_EQ(reference.metadata.at("spp"), "65");
  EXPECT_EQ(reference.metadata.at("kind"), "reference");
  EXPECT_EQ(reference.metadata.at("russian_roulette"), "off");
  EXPECT_EQ(reference.metadata.at("reference_key").size(), 32u);
  double fromHalves = 0.0, fromVariance = 0.0;
  for (size_t i = 0; i < mean.pixels.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double a = half0.pixels[i][channel], b = half1.pixels[i][channel];
      const double expected = (33.0 * a + 32.0 * b) / 65.0;  // the first half has one more sample
      ASSERT_NEAR(mean.pixels[i][channel], expected, 1e-5 * (1.0 + expected));
      ASSERT_GE(variance.pixels[i][channel], 0.0f);
      fromVariance += variance.pixels[i][channel];
      fromHalves += (a - b) * (a - b) * 33.0 * 32.0 / (65.0 * 65.0);
    }
  }
  EXPECT_GT(fromVariance, 0.0);
  // Both estimate the variance of the mean: 12,288 values of one degree of freedom each.
  EXPECT_NEAR(fromHalves / fromVariance, 1.0, 0.1);
}

TEST_F(ReferenceTest, TargetIsReachedAndSaidTruly) {
  ASSERT_EQ(
      run("reference cornell-box -o coarse.exr --resolution 24x24 --target-relmse 0.05 -q").code,
      0);
  ASSERT_EQ(
      run("reference cornell-box -o fine.exr --resolution 24x24 --target-relmse 0.005 -q").code, 0);
  const auto coarse = readExr(path("coarse.exr")).metadata,
             fine = readExr(path("fine.exr")).metadata;
  EXPECT_LE(std::stod(coarse.at("relmse_estimate")), 0.05);
  EXPECT_LE(std::stod(fine.at("relmse_estimate")), 0.005);
  EXPECT_GT(std::stoul(fine.at("spp")), std::stoul(coarse.at("spp")));
}

TEST_F(ReferenceTest, TimeLimitStops) {
  ASSERT_EQ(run("reference cornell-box -o ref.exr --resolution 24x24 --time-limit 0.5").code, 0);
  const auto metadata = readExr(path("ref.exr")).metadata;
  EXPECT_GE(std::stod(metadata.at("render_time_s")), 0.5);
  EXPECT_GE(std::stoul(metadata.at("spp")), 2u);
}

TEST_F(ReferenceTest, TargetThatIsMissedIsSaid) {
  const std::string start = "reference cornell-box -o ref.exr --resolution 24x24 --spp 8 ";
  const ProgramResult missed = run(start + "--target-relmse 1e-9");
  EXPECT_EQ(missed.code, 0) << missed.err;
  EXPECT_NE(missed.err.find("warning: ref.exr: relmse "), std::string::npos) << missed.err;
  EXPECT_NE(missed.err.find("stopped by --spp"), std::string::npos) << missed.err;
  EXPECT_EQ(run(start).err.find("warning"), std::string::npos);
}

TEST_F(ReferenceTest, SeedsOfMethodsAreNotSeedsOfHalves) {
  // If a half shared its samples with a method's image, that image's error would be hidden.
  ASSERT_EQ(run("reference cornell-box -o ref.exr --resolution 16x16 --spp 2 --seed 1").code, 0);
  ASSERT_EQ(run("render cornell-box -o image.exr --resolution 16x16 --frames 1 --seed 1").code, 0);
  const LayeredImage reference = readExr(path("ref.exr"));
  const Image image = readExr(path("image.exr")).layers.at("");
  EXPECT_NE(reference.layers.at("half0").pixels, image.pixels);
  EXPECT_NE(reference.layers.at("half1").pixels, image.pixels);
  EXPECT_NE(reference.layers.at("half0").pixels, reference.layers.at("half1").pixels);
}

}  // namespace

}  // namespace restlab::cli_test
