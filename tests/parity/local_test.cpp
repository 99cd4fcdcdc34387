// `local` with settings other than its defaults, on both machines: points at the corners of
// triangles, occlusion, several light samples, reflections.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/scene/compiled/compiled_scene.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"

namespace restlab::parity {
namespace {

TEST(LocalParity, EverySettingIsTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const auto scene = CompiledScene::build(makeBuiltinScene("glossy-gallery"));
  for (const char* shading : {"gouraud", "flat"}) {
    const auto image = [&](const Machine& where) {
      SessionConfig config = configOf({"local", "", ""}, where, 64, 36, 3);
      config.parameters = {{"model", std::string("phong")},
                           {"shading", std::string(shading)},
                           {"ambient", 0.3},
                           {"occlusion", std::string("rays")},
                           {"occlusion_rays", int64_t{2}},
                           {"light_samples", int64_t{3}},
                           {"reflections", std::string("glossy")}};
      Session session(scene, config);
      session.frame();
      return session.radiance();
    };
    const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kCpuBvh));
    std::printf("  %s: %s\n", shading, difference.text().c_str());
    EXPECT_LE(difference.different, 8u) << difference.text();
  }
}

}  // namespace
}  // namespace restlab::parity
