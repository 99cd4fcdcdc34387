// Lights switched between the frames of a session on a Vulkan device: recorded commands and bound
// texels refer to the scene before the switch.
#include <gtest/gtest.h>

#include <cstring>

#include "core/scene/compiled/light_factor.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/reads.h"

namespace restlab::parity {
namespace {

constexpr uint32_t kSeed = 5;

std::shared_ptr<const CompiledScene> gallery(const std::string& light, double factor) {
  return CompiledScene::build(withLightFactor(makeBuiltinScene("glossy-gallery"), light, factor));
}

Session open(const std::shared_ptr<const CompiledScene>& scene, const char* integrator) {
  Combination what;
  what.integrator = integrator;
  return Session(scene, configOf(what, kVulkanSpecialised, 48, 32, kSeed));
}

bool isSame(const Session& a, const Session& b) {
  const auto &x = a.radiance().pixels, &y = b.radiance().pixels;
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0;
}

class LightSwitch : public testing::TestWithParam<const char*> {};

TEST_P(LightSwitch, PathRendersWhatAFreshSessionDoes) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const Reads reads(GetParam());
  const auto on = gallery("all", 1.0), off = gallery("light-large", 0.0);
  Session live = open(on, "path"), fresh = open(off, "path");
  live.frames(3);
  live.setScene(off);
  live.frame();
  fresh.reset(kSeed, 3);
  fresh.frame();
  EXPECT_TRUE(isSame(live, fresh));
  live.setScene(on);
  live.frame();
  fresh.frame();
  EXPECT_FALSE(isSame(live, fresh)) << "it is on again";
}

// Clusters of lamps as well: there are more of these than clusters. A switch builds the hierarchy
// of the other scene.
TEST_P(LightSwitch, BothMachinesDrawTheSameLampsOfAHierarchy) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const Reads reads(GetParam());
  const auto hall = [](double factor) {
    return CompiledScene::build(
        withLightFactor(makeBuiltinScene("many-lights?lamps=2000"), "lamps-0-0", factor));
  };
  const auto on = hall(1.0), off = hall(0.0);
  const auto openByHierarchy = [&](const Machine& where) {
    Combination what;
    what.integrator = "path";
    SessionConfig config = configOf(what, where, 48, 32, kSeed);
    config.lightChoice = kLightChoiceTree;
    return Session(on, config);
  };
  Session host = openByHierarchy(kCpuBvh), device = openByHierarchy(kVulkanSpecialised);
  for (const auto& scene : {on, off}) {
    host.setScene(scene);
    device.setScene(scene);
    host.frame();
    device.frame();
    const FrameDifference difference = countDifferent(host.radiance(), device.radiance());
    EXPECT_LE(difference.share(), 0.01) << difference.text();
  }
}

TEST_P(LightSwitch, TheHistoryGoesOn) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const Reads reads(GetParam());
  const auto lit = [](double factor) {
    return CompiledScene::build(withLightFactor(makeBuiltinScene("door-ajar"), "all", factor));
  };
  const auto scene = lit(1.0);
  Session live = open(scene, "restir_gi"), kept = open(scene, "restir_gi");
  live.frames(5);
  kept.frames(5);
  live.setScene(lit(1.0));
  live.frames(2);
  kept.frames(2);
  EXPECT_TRUE(isSame(live, kept));
  live.setScene(lit(0.5));
  live.frames(2);
  kept.frames(2);
  EXPECT_FALSE(isSame(live, kept));
}

// A path traced again must find the same light, although another pipeline traces it.
TEST_P(LightSwitch, AStillLightChangesNoBit) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const Reads reads(GetParam());
  for (const char* name : {"door-ajar", "glossy-gallery"}) {
    // Kernels with lobes take long to compile: by night.
    if (name == std::string("glossy-gallery") && GetParam() == std::string("texels")) continue;
    const auto scene = sceneNamed(name);
    const auto run = [&](int64_t every) {
      Combination what;
      what.integrator = "restir_gi";
      what.cache = "voxel";
      SessionConfig config = configOf(what, kVulkanSpecialised, 47, 32, kSeed);
      config.parameters["validate_every"] = every;
      auto session = std::make_unique<Session>(scene, config);
      for (uint32_t frame = 0; frame < 8; ++frame) {
        session->setCamera(cameraOf(*scene, frame < 4 ? 0 : frame - 2));
        session->frame();
      }
      return session;
    };
    const auto plain = run(0), validated = run(4);
    EXPECT_TRUE(isSame(*plain, *validated)) << name;
  }
}

const auto kNameOf = [](const auto& how) { return std::string(how.param); };
INSTANTIATE_TEST_SUITE_P(Reading, LightSwitch, testing::Values("texels"), kNameOf);
INSTANTIATE_TEST_SUITE_P(Nightly, LightSwitch, testing::Values("addresses"), kNameOf);

}  // namespace
}  // namespace restlab::parity
