// Session::donors() and donor layers of a frame, on the Vulkan backend against the CPU backend.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"

namespace restlab::parity {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48;

class DonorsParity : public testing::TestWithParam<const char*> {};

// Pairs of partners depend on the surfaces at pixel centres; acceptance of a shift also depends on
// rounding: a sample that differs is a donor of three pixels.
TEST_P(DonorsParity, BothBackendsSayTheSame) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const auto scene = sceneNamed(GetParam());
  const Combination what{"restir_gi", "unbiased", "pixel"};
  SessionConfig onCpu = configOf(what, kCpuBvh, kWidth, kHeight, 5);
  SessionConfig onVulkan = configOf(what, kVulkanSpecialised, kWidth, kHeight, 5);
  // One kernel runs in several passes, over other buffers.
  for (SessionConfig* config : {&onCpu, &onVulkan})
    config->parameters["spatial_rounds"] = int64_t{2};
  Session cpu(scene, onCpu), vulkan(scene, onVulkan);
  cpu.frame();
  vulkan.frame();
  for (const auto& [layer, most] : {std::pair{"partner", 0.002}, {"rejected_shifts", 0.01}}) {
    const Image a = cpu.aov(layer), b = vulkan.aov(layer);
    size_t different = 0, some = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
      different += a.pixels[i] != b.pixels[i];
      some += a.pixels[i].x > 0.0f;
    }
    EXPECT_LE(double(different), most * double(a.pixels.size())) << layer;
    EXPECT_GT(some, a.pixels.size() / 20) << layer;
  }
  const Image confidence = vulkan.aov("confidence");
  size_t pixels = 0, different = 0;
  for (uint32_t y = 0; y < kHeight; y += 3) {
    for (uint32_t x = 0; x < kWidth; x += 3) {
      const std::vector<Donor> a = cpu.donors(x, y), b = vulkan.donors(x, y);
      bool isSame = a.size() == b.size();
      double sum = 0.0;
      for (size_t k = 0; k < b.size(); ++k) {
        sum += b[k].confidence;
        isSame = isSame && a[k].id == b[k].id && a[k].shift == b[k].shift &&
                 a[k].isSelected == b[k].isSelected &&
                 std::abs(a[k].share.value_or(0.0) - b[k].share.value_or(0.0)) < 1e-3;
      }
      EXPECT_NEAR(sum, double(confidence.at(x, y).x), 1e-5 * sum) << x << "," << y;
      ++pixels;
      different += isSame ? 0 : 1;
    }
  }
  EXPECT_LE(double(different), 0.02 * double(pixels));
}

INSTANTIATE_TEST_SUITE_P(Scene, DonorsParity, testing::Values("cornell-box", "everything"),
                         [](const auto& test) {
                           return std::string(test.param) == "everything" ? "everything"
                                                                          : "cornell_box";
                         });

}  // namespace
}  // namespace restlab::parity
