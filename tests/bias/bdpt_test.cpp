// `bdpt` and `path` have one mean: two estimators that share no choice of lights and no weights.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bias/bdpt_scenes.h"
#include "tests/bias/independent_runs.h"
#include "tests/varied_scenes.h"

namespace restlab::bias {
namespace {

Method bdptMethod(uint32_t frames, const ParameterMap& parameters = {}) {
  Method m = pathMethod(frames);
  m.name = "bdpt";
  m.config.integrator = "bdpt";
  m.config.parameters = parameters;
  return m;
}

struct BdptEffort {
  size_t runs;
  uint32_t truthFrames, frames;
};
constexpr BdptEffort kQuick{32, 24, 4}, kNight{96, 48, 8};

void expectTheMeanOfPath(const std::shared_ptr<const CompiledScene>& scene,
                         const BdptEffort& effort,
                         const std::function<void(SessionConfig&)>& change = {}) {
  Method path = pathMethod(effort.truthFrames), bdpt = bdptMethod(effort.frames);
  for (Method* m : {&path, &bdpt}) {
    m->config.width = 32;
    m->config.height = 24;
    if (change) change(m->config);
  }
  const stats::Truth truth = stats::truthOf(independentRuns(scene, path, 1, effort.runs));
  const stats::BiasReport report = testMethod(scene, bdpt, truth, effort.runs);
  EXPECT_FALSE(report.failed()) << report.text();
}

std::shared_ptr<const CompiledScene> compiled(const std::string& name) {
  for (const BdptScene& scene : bdptScenes())
    if (scene.name == name) return CompiledScene::build(scene.make());
  return nullptr;
}

TEST(Bdpt, HasTheMeanOfPath) {
  expectTheMeanOfPath(builtinScene("cornell-box"), kQuick);
  for (const char* name : {"smooth", "punctual", "sky"})
    expectTheMeanOfPath(compiled(name), kQuick);
}

class BdptNight : public ::testing::TestWithParam<BdptScene> {};

TEST_P(BdptNight, NightlyHasTheMeanOfPath) {
  expectTheMeanOfPath(CompiledScene::build(GetParam().make()), kNight,
                      [](SessionConfig& c) { c.threads = 0; });
}

INSTANTIATE_TEST_SUITE_P(Scenes, BdptNight, ::testing::ValuesIn(bdptScenes()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Bdpt, NightlyHasTheMeanOfPathInBuiltinScenes) {
  for (const std::string& name : test::variedScenes())
    expectTheMeanOfPath(builtinScene(name), kNight, [](SessionConfig& c) { c.threads = 0; });
}

}  // namespace
}  // namespace restlab::bias
