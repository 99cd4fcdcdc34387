// Partly transparent surfaces: path rays pass them at random, while they dim shadow rays and
// reconnections. Reuse must combine both estimates of one integrand.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

// A room divided by screens of coverage 1/2: neighbouring pixels see a vertex through them or past
// them. With `lampCoverage` below 1 the large lamp is such a screen, too.
std::shared_ptr<const CompiledScene> screens(float lampCoverage) {
  using namespace builtin;
  SceneBuilder scene("screens");
  const uint32_t wall = scene.addMaterial("wall", lambert({0.7f, 0.6f, 0.5f}));
  rl::Material light = lamp({3.0f, 2.5f, 2.0f});
  light.alpha = lampCoverage;
  if (lampCoverage < 1.0f) light.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  const uint32_t lamp = scene.addMaterial("lamp", light);
  rl::Material half = lambert({0.6f, 0.3f, 0.2f});
  half.alpha = 0.5f;
  half.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  const uint32_t screen = scene.addMaterial("screen", half);
  scene.add(insideOut(box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})), wall);
  scene.add(quad("lamp", {-1.8, 2.8, -2.6}, {1.8, 0.0, 0.0}, {0.0, 0.0, 1.6}), lamp);
  for (const double x : {-1.5, -0.5, 0.5, 1.5}) {
    scene.add(box("screen", {x - 0.25, 0.2, -0.9}, {x + 0.25, 2.6, -0.85}), screen);
  }
  scene.addCamera("front", {0.3, 1.6, 1.7}, {0.0, 1.2, -1.5}, 60.0);
  return CompiledScene::build(scene.finish());
}

void expectUnbiased(float lampCoverage) {
  constexpr size_t kRuns = 512;
  const auto scene = screens(lampCoverage);
  for (const uint32_t component : {rl::RL_COMPONENT_INDIRECT, rl::RL_COMPONENT_DIRECT}) {
    const auto adapted = [&](Method method) {
      method.config.components = component;
      method.config.threads = 0;
      method.name += component == rl::RL_COMPONENT_DIRECT ? ", direct" : ", indirect";
      return method;
    };
    const stats::Truth truth =
        stats::truthOf(independentRuns(scene, adapted(pathMethod(64)), 1, kRuns));
    const stats::BiasReport report = testMethod(scene, adapted(restirMethod(32, 4)), truth, kRuns);
    EXPECT_FALSE(report.failed()) << report.text();
  }
}

TEST(Transparency, NightlyScreensLeaveTheMean) { expectUnbiased(1.0f); }
TEST(Transparency, NightlyATransparentLampLeavesTheMean) { expectUnbiased(0.5f); }

}  // namespace
}  // namespace restlab::bias
