// `local` with settings other than its defaults, on both machines: points at the corners of
// triangles, occlusion by rays and on the screen, several light samples and one of each light,
// reflections, shadow maps, combined textures.
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

FrameDifference differenceOf(const std::string& scene, const ParameterMap& parameters) {
  const auto image = [&](const Machine& where) {
    SessionConfig config = configOf({"local", "", ""}, where, 64, 36, 3);
    config.parameters = parameters;
    Session session(sceneNamed(scene), config);
    session.frame();
    return session.radiance();
  };
  const FrameDifference difference = countDifferent(image(kVulkanSpecialised), image(kCpuBvh));
  std::printf("  %s: %s\n", scene.c_str(), difference.text().c_str());
  return difference;
}

// A map of a few texels: a ray of another result changes a whole block of pixels.
TEST(LocalParity, ShadowMapsAreTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const char* scene : {"glossy-gallery", "courtyard", "floor?spots=3", "shapes"}) {
    const FrameDifference difference = differenceOf(scene, {{"shadows", std::string("map")},
                                                            {"shadow_map_size", int64_t{64}},
                                                            {"shadow_maps", int64_t{36}},
                                                            {"light_samples", int64_t{4}}});
    EXPECT_LE(difference.different, 12u) << scene << ": " << difference.text();
  }
}

TEST(LocalParity, TheScreenIsTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const char* scene : {"glossy-gallery", "shapes"}) {
    const FrameDifference difference = differenceOf(scene, {{"preset", std::string("reflections")},
                                                            {"occlusion", std::string("screen")},
                                                            {"occlusion_rays", int64_t{4}},
                                                            {"light_samples", int64_t{0}}});
    EXPECT_LE(difference.different, 12u) << scene << ": " << difference.text();
  }
}

TEST(LocalParity, CombinedTexturesAreTheSameOnBothMachines) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (const char* combine : {"replace", "decal", "add"}) {
    const FrameDifference difference = differenceOf(
        "everything", {{"texture_combine", std::string(combine)}, {"ambient_share", 0.2}});
    EXPECT_LE(difference.different, 12u) << combine << ": " << difference.text();
  }
}

}  // namespace
}  // namespace restlab::parity
