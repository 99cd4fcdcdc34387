// Denoisers that filter by features give the same image on the CPU and on a Vulkan device.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/denoise/layered_images.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/reads.h"

namespace restlab::parity {
namespace {

using denoise::filterConfig;
using denoise::imageOf;
using denoise::noiseAt;

class Filters : public testing::TestWithParam<std::string> {};

// A wall, a floor, the background and a lamp, all noisy, under a moving camera; one depth and one
// normal are NaN.
LayeredFrame frameOf(glm::uvec2 size, uint32_t frame) {
  LayeredFrame layers;
  const auto isBackground = [](glm::uvec2 p) { return p.y < 6u; };
  const auto isFloor = [](glm::uvec2 p) { return p.y >= 30u; };
  layers.radiance = imageOf(size, [&](glm::uvec2 p) {
    const float u = noiseAt(p, frame);
    return glm::vec3(u < 0.2f ? 8.0f * u : 0.0f, u, 1.0f - u);
  });
  layers.normalW = imageOf(size, [&](glm::uvec2 p) {
    if (isBackground(p)) return glm::vec3(0.0f);
    return isFloor(p) ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f);
  });
  layers.depthMetres = imageOf(size, [&](glm::uvec2 p) {
    if (isBackground(p)) return glm::vec3(0.0f);
    return glm::vec3(isFloor(p) ? 120.0f / float(p.y) : 4.0f);
  });
  layers.depthMetres.pixels[20 * size.x + 50] = glm::vec3(std::nanf(""));
  layers.normalW.pixels[22 * size.x + 60] = glm::vec3(std::nanf(""));
  layers.albedo = imageOf(size, [](glm::uvec2 p) {
    return glm::vec3(0.5f + 0.4f * std::sin(float(p.x)), 0.3f, 0.001f);
  });
  layers.lights = imageOf(
      size, [](glm::uvec2 p) { return glm::vec3(p.x / 8u == 2u && p.y / 8u == 1u ? 1.0f : 0.0f); });
  layers.motion = imageOf(size, [](glm::uvec2) { return glm::vec3(0.4f, -0.3f, 0.0f); });
  return layers;
}

TEST_P(Filters, ShowTheSame) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const glm::uvec2 size = {96, 48};
  for (const char* way : {"texels", "addresses"}) {
    const Reads reads(way);
    SessionConfig onDevice = filterConfig(GetParam(), size, 1, "vulkan");
    onDevice.validate = true;
    ImageDenoiser cpu(filterConfig(GetParam(), size)), vulkan(onDevice);
    for (uint32_t i = 0; i < 6; ++i) {
      const LayeredFrame layers = frameOf(size, i);
      const Image a = cpu.frame(layers), b = vulkan.frame(layers);
      for (size_t p = 0; p < a.pixels.size(); ++p) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(a.pixels[p][c], b.pixels[p][c], 1e-4f * (0.1f + std::abs(a.pixels[p][c])))
              << way << ", frame " << i << ", pixel " << p << ", channel " << c;
        }
      }
      EXPECT_EQ(cpu.stats().health.counts[rl::RL_HEALTH_NONFINITE], 2u);
      EXPECT_EQ(cpu.stats().health.counts, vulkan.stats().health.counts) << "frame " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Filters, testing::ValuesIn(denoise::filters()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace restlab::parity
