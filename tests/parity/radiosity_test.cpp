// `radiosity` with each solver and each kind of factors, on both machines.
#include <gtest/gtest.h>

#include <cstdio>

#include "core/scene/compiled/compiled_scene.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"

namespace restlab::parity {
namespace {

TEST(RadiosityParity, EverySolverIsTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const auto scene = CompiledScene::build(makeBuiltinScene("cornell-box"));
  const ParameterMap small = {{"elements", int64_t{128}},
                              {"factor_rays", int64_t{64}},
                              {"light_samples", int64_t{32}},
                              {"iterations", int64_t{6}},
                              {"tolerance", 0.0}};
  const auto compare = [&](const char* solver, const char* factors) {
    const auto image = [&](const Machine& where) {
      SessionConfig config = configOf({"radiosity", "", ""}, where, 64, 36, 3);
      config.maxBounces = 64;
      config.parameters = small;
      config.parameters["solver"] = std::string(solver);
      config.parameters["factors"] = std::string(factors);
      config.parameters["iterations_per_frame"] = int64_t{4};
      Session session(scene, config);
      session.frames(2);
      EXPECT_EQ(session.residuals().size(), 6u);
      return session.radiance();
    };
    const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kCpuBvh));
    std::printf("  %s, %s: %s\n", solver, factors, difference.text().c_str());
    EXPECT_LE(difference.different, 8u) << difference.text();
  };
  compare("jacobi", "rays");
  compare("gauss_seidel", "polygon");
  compare("southwell", "rays");
}

}  // namespace
}  // namespace restlab::parity
