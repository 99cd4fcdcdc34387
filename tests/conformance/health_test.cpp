// No non-finite values, on any built-in scene and at any size.
#include <gtest/gtest.h>

#include "core/image/metrics/metrics.h"
#include "tests/bias/few_entries.h"
#include "tests/conformance/variants.h"
#include "tests/varied_scenes.h"

namespace restlab::conformance {
namespace {

class Healthy : public ::testing::TestWithParam<Variant> {
 protected:
  void expectHealthy(const std::string& sceneName, const SessionConfig& config, uint32_t frames) {
    Session session(bias::builtinScene(sceneName), config);
    for (uint32_t i = 0; i < frames; ++i) {
      const FrameStats stats = session.frame();
      EXPECT_EQ(stats.health.counts[rl::RL_HEALTH_NONFINITE], 0u) << sceneName << ", frame " << i;
      EXPECT_EQ(countNonfinite(session.radiance()), 0u) << sceneName << ", frame " << i;
      EXPECT_EQ(session.radiance().width, config.width);
      EXPECT_EQ(session.radiance().height, config.height);
      EXPECT_GT(stats.raysPath, 0u);
    }
  }
};

TEST_P(Healthy, OnEveryBuiltinScene) {
  for (const std::string& scene : test::variedScenes()) {
    const SessionConfig config = configOf(GetParam(), 64, 36);
    const bool hasShapes = (scanFeatures(makeBuiltinScene(scene)) & rl::RL_FEATURE_SHAPES) != 0;
    if (hasShapes && bias::hasElements(config)) continue;
    expectHealthy(scene, config, 8);
  }
}

TEST_P(Healthy, AtOddSizes) {
  const std::array<uint32_t, 2> sizes[] = {{1, 1}, {1, 9}, {13, 1}, {17, 16}, {31, 33}, {3, 200}};
  for (const auto& [width, height] : sizes) {
    for (const char* scene : {"cornell-box", "glass", "courtyard"}) {
      expectHealthy(scene, configOf(GetParam(), width, height), 4);
    }
  }
}

// A single pixel shows the mean of the image: its average over many seeds must be that mean. The
// camera's field of view is vertical, so a square image has the same one.
TEST_P(Healthy, OnePixelShowsTheMeanOfTheImage) {
  const auto scene = bias::builtinScene("sphere-furnace");
  SessionConfig config = configOf(GetParam(), 1, 1);
  Session session(scene, config);
  double sum = 0.0;
  // Without a BSDF sample beside the light sample there is more noise.
  const int seeds = GetParam().leavesLightOut() && !bias::hasElements(config) ? 1024 : 64;
  for (int i = 0; i < seeds; ++i) {
    session.reset(uint32_t(i + 1));
    session.frame();
    session.frame();
    sum += double(session.radiance().pixels[0].y);
  }
  EXPECT_NEAR(sum / seeds, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Every, Healthy, ::testing::ValuesIn(byDay(allVariants())), VariantName());
INSTANTIATE_TEST_SUITE_P(Nightly, Healthy, ::testing::ValuesIn(byNight(allVariants())),
                         VariantName());

}  // namespace
}  // namespace restlab::conformance
