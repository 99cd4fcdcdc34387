// Each strategy of `bdpt` on both machines: integers add up the splats of either alike.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/scene/compiled/compiled_scene.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"

namespace restlab::parity {
namespace {

TEST(BdptParity, EveryStrategyIsTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const char* name : {"glossy-gallery", "courtyard"}) {
    const auto scene = CompiledScene::build(makeBuiltinScene(name));
    for (const char* strategy : {"light", "connect", "splat"}) {
      const auto image = [&](const Machine& where) {
        SessionConfig config = configOf({"bdpt", "", ""}, where, 48, 27, 3);
        config.parameters = {{"strategy", std::string(strategy)},
                             {"heuristic", std::string("balance")}};
        Session session(scene, config);
        session.frame();
        return session.radiance();
      };
      const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kCpuBvh));
      std::printf("  %s, %s: %s\n", name, strategy, difference.text().c_str());
      EXPECT_LE(difference.different, 8u) << difference.text();
    }
  }
}

}  // namespace
}  // namespace restlab::parity
