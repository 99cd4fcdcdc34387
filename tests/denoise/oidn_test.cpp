// Tests of oidn, if this program was built with it: the network must get the right inputs.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/denoise/layered_images.h"

namespace restlab::denoise {
namespace {

class Oidn : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    for (const MissingDenoiser& missing : missingDenoisers()) {
      if (missing.name == "oidn") GTEST_SKIP() << "SKIPPED: " << missing.whyNot;
    }
  }
  static SessionConfig config(glm::uvec2 size) {
    SessionConfig config = filterConfig("oidn", size);
    config.parameters["oidn_quality"] = GetParam();
    return config;
  }
};

TEST_P(Oidn, ConstantsPass) {
  const glm::uvec2 size = {96, 64};
  const glm::vec3 value(2.0f, 1.0f, 0.5f);
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.radiance = Image(size.x, size.y, value);
  const Image shown = denoiser.frame(frame);
  for (size_t p = 0; p < shown.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.pixels[p][c] / value[c], 1.0f, 0.02f) << p;
  }
}

// Noise on a texture that the albedo shows. Two frames: the filter object is kept between them.
TEST_P(Oidn, NoiseFallsAndTexturesStay) {
  const glm::uvec2 size = {96, 64};
  ImageDenoiser denoiser(config(size));
  LayeredFrame frame;
  frame.albedo = imageOf(
      size, [](glm::uvec2 p) { return glm::vec3((p.x / 8u + p.y / 8u) % 2u == 0u ? 0.8f : 0.2f); });
  for (uint32_t i = 0; i < 2; ++i) {
    frame.radiance = imageOf(size, [&](glm::uvec2 p) {
      return 2.0f * noiseAt(p, i) * frame.albedo.pixels[size_t(p.y) * size.x + p.x];
    });
    const Image shown = denoiser.frame(frame);
    double before = 0.0, after = 0.0, sum = 0.0, right = 0.0;
    for (size_t p = 0; p < shown.pixels.size(); ++p) {
      const double truth = frame.albedo.pixels[p].y;
      before += std::pow(frame.radiance.pixels[p].y - truth, 2.0);
      after += std::pow(shown.pixels[p].y - truth, 2.0);
      sum += shown.pixels[p].y;
      right += truth;
    }
    EXPECT_LT(after, 0.2 * before) << "frame " << i;
    EXPECT_NEAR(sum / right, 1.0, 0.05) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, Oidn, testing::Values("fast", "balanced", "high"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace restlab::denoise
