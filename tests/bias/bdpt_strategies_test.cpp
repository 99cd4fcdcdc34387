// Strategies of `bdpt` by themselves: each that can make all paths of a length finds the same light
// as `path`, and the shares that their weights give add up to the whole.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/builtin/builder.h"
#include "tests/bias/bdpt_scenes.h"
#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

constexpr const char* kStrategies[] = {"emission", "light", "connect", "splat"};

// Paths of one number of scattering events, over rough surfaces.
Method ofLength(const char* integrator, uint32_t events, uint32_t frames,
                const ParameterMap& parameters = {}) {
  Method m = pathMethod(frames);
  m.name = integrator;
  m.config.integrator = integrator;
  m.config.parameters = parameters;
  m.config.width = 32;
  m.config.height = 24;
  m.config.maxBounces = events;
  m.config.components = events == 1 ? rl::RL_COMPONENT_DIRECT : rl::RL_COMPONENT_INDIRECT;
  return m;
}

// The lamp is not in view: direct light is that of one event.
std::shared_ptr<const CompiledScene> roughRoom() {
  Scene scene = bdptRoom("rough room", builtin::lambert({0.2f, 0.5f, 0.7f}),
                         builtin::lambert({0.6f, 0.4f, 0.3f}));
  scene.cameras.at(0).yfov = 0.65;
  return CompiledScene::build(std::move(scene));
}

void expectEachAlone(size_t runs, uint32_t frames) {
  const auto scene = roughRoom();
  for (const uint32_t events : {1u, 2u}) {
    const stats::Truth truth =
        stats::truthOf(independentRuns(scene, ofLength("path", events, 4 * frames), 1, runs));
    for (const char* strategy : kStrategies) {
      if (events == 1 && std::string(strategy) == "connect") continue;  // s = 2, t = 2 has two
      Method method =
          ofLength("bdpt", events, frames,
                   {{"strategy", std::string(strategy)}, {"heuristic", std::string("none")}});
      method.name = std::string(strategy) + ", " + std::to_string(events) + " events";
      const stats::BiasReport report = testMethod(scene, method, truth, runs);
      EXPECT_FALSE(report.failed()) << method.name << ": " << report.text();
    }
  }
}

TEST(BdptStrategies, EachAloneFindsAllLight) { expectEachAlone(32, 8); }
TEST(BdptStrategies, NightlyEachAloneFindsAllLight) { expectEachAlone(96, 64); }

Image imageOf(const std::shared_ptr<const CompiledScene>& scene, const std::string& strategy,
              int threads) {
  SessionConfig config = pathMethod(1).config;
  config.integrator = "bdpt";
  config.width = 32;
  config.height = 18;
  config.parameters = {{"strategy", strategy}};
  config.threads = threads;
  Session session(scene, config);
  session.frame();
  session.frame();
  return session.radiance();
}

TEST(BdptStrategies, SharesAddUpToTheWhole) {
  for (const BdptScene& made : bdptScenes()) {
    const auto scene = CompiledScene::build(made.make());
    const Image whole = imageOf(scene, "all", 1);
    Image sum(whole.width, whole.height);
    for (const char* strategy : kStrategies) {
      const Image share = imageOf(scene, strategy, 1);
      for (size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += share.pixels[p];
    }
    for (size_t p = 0; p < sum.pixels.size(); ++p)
      ASSERT_NEAR(sum.pixels[p].y, whole.pixels[p].y, 1e-5 * (1.0 + double(whole.pixels[p].y)))
          << made.name << ", pixel " << p;
  }
}

TEST(BdptStrategies, SplatsDoNotDependOnThreads) {
  const auto scene = roughRoom();
  const Image one = imageOf(scene, "all", 1);
  for (int round = 0; round < 3; ++round)
    EXPECT_EQ(imageOf(scene, "all", 2).pixels, one.pixels) << round;
}

}  // namespace
}  // namespace restlab::bias
