// `bdpt` and `path` have one mean: two estimators that share no choice of lights and no weights.
#include <gtest/gtest.h>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
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
constexpr BdptEffort kQuick{48, 48, 4}, kNight{256, 128, 16};

void expectTheMeanOfPath(const std::shared_ptr<const CompiledScene>& scene,
                         const BdptEffort& effort,
                         const std::function<void(SessionConfig&)>& change = {}) {
  Method path = pathMethod(effort.truthFrames), bdpt = bdptMethod(effort.frames);
  for (Method* m : {&path, &bdpt}) {
    m->config.width = 48;
    m->config.height = 36;
    if (change) change(m->config);
  }
  const stats::Truth truth = stats::truthOf(independentRuns(scene, path, 1, effort.runs));
  const stats::BiasReport report = testMethod(scene, bdpt, truth, effort.runs);
  EXPECT_FALSE(report.failed()) << report.text();
}

TEST(Bdpt, NightlyHasTheMeanOfPathInBuiltinScenes) {
  for (const std::string& name : test::variedScenes())
    expectTheMeanOfPath(builtinScene(name), kQuick, [](SessionConfig& c) { c.threads = 2; });
}

}  // namespace
}  // namespace restlab::bias
