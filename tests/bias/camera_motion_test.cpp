// A moving camera: donors come from other pixels or from entries in space, and were shaded for
// another eye. The image of the last camera must not depend on where the camera was before, with
// any cache.
#include <gtest/gtest.h>

#include "core/frame/cache.h"
#include "tests/bias/few_entries.h"
#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

struct Walk {
  const char* name;
  const char* scene;
  glm::dvec3 stepW;  // metres per frame
  double turnDegrees;
  bool showsTheLamp = false;  // in the Cornell box: use the scene's own camera, which sees the lamp
  double untestable = 0.1;    // bound on the share of the area whose runs are too skewed to test
  bool isBack = false;        // the first half of the frames has the last camera
};

void PrintTo(const Walk& w, std::ostream* out) { *out << w.name; }

struct Setting {
  std::string cache;
  ParameterMap parameters = {};
  std::string integrator = "restir_gi";
};
std::vector<Setting> allCaches() {
  std::vector<Setting> all;
  for (const CacheInfo* info : cacheRegistry()) all.push_back({info->name});
  return all;
}

struct Effort {
  size_t runs;
  uint32_t truthFrames;  // in each of 128 runs of `path`
  int threads;
};
constexpr Effort kEveryDay{128, 48, 1};
constexpr Effort kNightly{2048, 384, 0};

// Takes half of a test's time, so walks that end at one camera share a test.
stats::Truth truthAt(const std::string& scene, const SceneCamera& end, const Effort& effort) {
  Method truth = pathMethod(effort.truthFrames);
  truth.cameras = {end};
  truth.config.threads = effort.threads;
  return stats::truthOf(independentRuns(builtinScene(scene), truth, 1, 128));
}

// Compares only the last frame of a history, because every frame has its own camera.
void expectUnbiased(const Walk& walk, const SceneCamera& end, const stats::Truth& truth,
                    const Effort& effort, uint32_t frames,
                    const std::vector<Setting>& settings = allCaches()) {
  for (const Setting& setting : settings) {
    Method method = restirMethod(frames, frames - 1, setting.parameters, setting.integrator);
    method.config.cache = setting.cache;
    method.name = std::string(walk.name) + " camera, " + method.name + ", " + setting.cache;
    method.cameras = walkTo(end, frames, walk.stepW, walk.turnDegrees);
    // Walks there and back: the first half of the frames has the last camera.
    for (uint32_t i = 0; walk.isBack && i < frames / 2; ++i) method.cameras[i] = end;
    method.config.threads = effort.threads;
    const stats::BiasReport report =
        testMethod(builtinScene(walk.scene), method, truth, effort.runs);
    EXPECT_FALSE(report.failed()) << method.name << ": " << report.text();
    EXPECT_LE(report.untestableShare, walk.untestable) << method.name << ": " << report.text();
  }
}

SceneCamera endOf(const Walk& walk) {
  const std::string scene = walk.scene;
  if (scene == "cornell-box" && !walk.showsTheLamp) return cornellBelowTheLamp();
  return makeBuiltinScene(scene).cameras.at(0);
}

const Walk kWalking{"walking", "cornell-box", {0.06, 0.01, -0.05}, 0.0};
const Walk kTurning{"turning", "cornell-box", {0.0, 0.0, 0.0}, 1.5};
const Walk kWalkingAndTurning{"walking and turning", "cornell-box", {0.06, 0.01, -0.05}, 1.5};
// The outline of the lamp moves through the pixels.
const Walk kPastTheLamp{"past_the_lamp", "cornell-box", {0.05, 0.03, 0.0}, 0.0, true};
const Walk kAwayAndBack{"away", "cornell-box", {0.5, 0.2, -0.3}, 20.0, false, 0.1, true};

// Cells and discs across edges and through walls, many donors, and entries with a short memory.
std::vector<Setting> openEntries() {
  const ParameterMap open = {{"normal_threshold", -1.0}, {"plane_threshold", 10.0},
                             {"max_jacobian", 1.0e6},    {"entry_spread", 8.0},
                             {"feed_every", int64_t{1}}, {"entry_proposals", int64_t{4}}};
  std::vector<Setting> settings;
  for (const std::string& cache : cachesWithEntries()) {
    settings.push_back({cache, open});
    settings.push_back(
        {cache, {{cache + "_pixels", 16.0}, {"entry_cap", 2.0}, {"entries", int64_t{1024}}}});
  }
  return settings;
}

TEST(MovingCamera, NightlyBelowTheLampLeavesTheMean) {
  const SceneCamera end = cornellBelowTheLamp();
  const stats::Truth truth = truthAt("cornell-box", end, kEveryDay);
  expectUnbiased(kWalkingAndTurning, end, truth, kEveryDay, 6);
  expectUnbiased(kAwayAndBack, end, truth, kEveryDay, 8);
  expectUnbiased(kWalkingAndTurning, end, truth, kEveryDay, 6, openEntries());
}

TEST(MovingCamera, PastTheLampLeavesTheMean) {
  const SceneCamera end = endOf(kPastTheLamp);
  std::vector<Setting> settings = allCaches();
  for (const Setting& setting : allCaches()) settings.push_back({setting.cache, {}, "restir_di"});
  expectUnbiased(kPastTheLamp, end, truthAt("cornell-box", end, kEveryDay), kEveryDay, 6, settings);
}

TEST(MovingCamera, NightlyAmongGlossLeavesTheMean) {
  const Effort effort{256, 16, 1};
  const Walk walk{"strolling", "glossy-gallery", {0.04, 0.0, -0.06}, 0.7};
  const SceneCamera end = endOf(walk);
  expectUnbiased(walk, end, truthAt(walk.scene, end, effort), effort, 5);
}

// Through the open side of the Cornell box. The level of its cells and the size of its discs change
// once or twice on the way, and entries of the old level are used until there are new ones.
TEST(MovingCamera, NightlyFlyThroughLeavesTheMean) {
  const Walk walk{"flying", "cornell-box", {0.0, -0.02, -0.8}, 0.0};
  const SceneCamera end = lookAt({-2.78, 2.7, -1.5}, {-2.78, 2.4, -5.5}, 55.0);
  std::vector<Setting> settings;
  for (const std::string& cache : cachesWithEntries())
    settings.push_back({cache, {{"entries", int64_t{4096}}}});
  expectUnbiased(walk, end, truthAt(walk.scene, end, kNightly), kNightly, 10, settings);
}

class MovingCameraNightly : public ::testing::TestWithParam<Walk> {};
TEST_P(MovingCameraNightly, LeavesTheMean) {
  const Walk& walk = GetParam();
  const SceneCamera end = endOf(walk);
  expectUnbiased(walk, end, truthAt(walk.scene, end, kNightly), kNightly, 16);
}
INSTANTIATE_TEST_SUITE_P(
    Builtin, MovingCameraNightly,
    ::testing::Values(kWalking, kTurning, kPastTheLamp,
                      Walk{"past_glass", "glass", {0.02, 0.01, 0.0}, 0.5, false, 0.6},
                      Walk{"strolling_glossy", "glossy-gallery", {0.04, 0.0, -0.06}, 0.7},
                      Walk{"strolling_door", "door-ajar", {0.04, 0.0, -0.03}, -0.5},
                      Walk{"strolling_courtyard", "courtyard", {0.05, 0.0, -0.05}, 0.5}),
    [](const ::testing::TestParamInfo<Walk>& walk) { return std::string(walk.param.name); });

}  // namespace
}  // namespace restlab::bias
