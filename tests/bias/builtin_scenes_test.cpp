// `path` and unbiased methods of reuse on the built-in scenes: no cell of the image may differ from
// `path` with other seeds.
//
// Methods of reuse run with its defaults and with all safeguards open: donors from anywhere, with
// any normal, plane or roughness, and Jacobians of any size, in two rounds. That raises the
// variance but must not move the mean: reuse is unbiased by its weights, not by the tests of
// similarity.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

struct Case {
  const char* name;  // of the test
  const char* scene;
  uint32_t components;
  std::vector<SceneCamera> cameras = {};  // empty: the scene's own
  // Bounds on the share of the area whose runs are too skewed to test, by default and with all
  // safeguards open; a few hundredths without dominant rare paths.
  double untestable = 0.1, untestableOpen = 0.1;
  // Factor on the frames per run: means of more frames are less skewed.
  uint32_t longer = 1;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

struct Effort {
  size_t runs;
  uint32_t truthFrames, pathFrames;  // per run of `path`
  uint32_t frames, skipped;          // per history of a method of reuse
  int threads;
};

ParameterMap openParameters(const std::string& integrator) {
  ParameterMap open = {{"normal_threshold", -1.0},     {"plane_threshold", 10.0},
                       {"roughness_limit", 0.05},      {"spatial_neighbours", int64_t{2}},
                       {"spatial_rounds", int64_t{2}}, {"spatial_radius", 48.0}};
  if (integrator != "restir_di") open["max_jacobian"] = 1.0e6;
  if (integrator == "restir_pt") open["light_candidates"] = int64_t{4};
  return open;
}

// Leaves slow cases that show little to the nightly tests.
bool isWorthIt(const Case& c, const Effort& effort) {
  return effort.threads == 0 || c.longer == 1 || c.untestableOpen < 0.5;
}

void expectUnbiased(const Case& c, Effort effort, const std::string& integrator = "restir_gi") {
  for (uint32_t* frames : {&effort.truthFrames, &effort.pathFrames, &effort.frames})
    *frames *= c.longer;
  const auto scene = builtinScene(c.scene);
  const auto adapted = [&](Method method, const std::string& suffix) {
    method.name += suffix;
    method.config.components = c.components;
    method.cameras = c.cameras;
    method.config.threads = effort.threads;
    return method;
  };
  const Method truth = adapted(pathMethod(effort.truthFrames), "");
  const stats::Truth reference = stats::truthOf(independentRuns(scene, truth, 1, effort.runs));
  const auto restir = [&](const ParameterMap& parameters) {
    return restirMethod(effort.frames, effort.skipped, parameters, integrator);
  };
  std::vector<std::pair<Method, double>> methods = {{adapted(restir({}), ""), c.untestable}};
  // `path` against itself cannot show a bias, only false rejections.
  if (effort.threads == 0)
    methods.push_back({adapted(pathMethod(effort.pathFrames), ""), c.untestable});
  if (isWorthIt(c, effort))
    methods.push_back(
        {adapted(restir(openParameters(integrator)), ", safeguards open"), c.untestableOpen});
  // Roulette acts in the prefix that is replayed. The truth has none, and the same mean.
  if (integrator == "restir_pt") methods.back().first.config.russianRoulette = true;
  for (const auto& [method, untestable] : methods) {
    const stats::BiasReport report = testMethod(scene, method, reference, effort.runs);
    EXPECT_FALSE(report.failed()) << c.name << ", " << method.name << ": " << report.text();
    EXPECT_EQ(report.nonfinite, 0u) << c.name << ", " << method.name;
    EXPECT_LE(report.untestableShare, untestable) << c.name << ", " << method.name;
  }
}

constexpr uint32_t kAll = rl::RL_COMPONENT_ALL;
const std::vector<Case> kCases = {
    {"cornell_box", "cornell-box", kAll},
    // Lamp out of view: its outline is most of the noise seen from outside.
    {"cornell_box_inside", "cornell-box", kAll, {cornellBelowTheLamp()}},
    {"door_ajar", "door-ajar", kAll},
    {"door_ajar_indirect", "door-ajar", rl::RL_COMPONENT_INDIRECT},
    // Mostly dark. With all safeguards open, carried estimates of lit pixels reach dark ones: rare
    // noise of zero mean, too skewed to test in 49 % of the area.
    {"door_ajar_direct", "door-ajar", rl::RL_COMPONENT_DIRECT, {}, 0.1, 0.6},
    // Noise is mostly caustics: in short runs 64 % of the area is too skewed to test.
    {"glossy_gallery", "glossy-gallery", kAll, {}, 0.1, 0.6, 4},
    {"many_lights", "many-lights", kAll},
    {"glass", "glass", kAll, {}, 0.85, 0.85},
    {"courtyard", "courtyard", kAll},
};

std::string caseName(const ::testing::TestParamInfo<Case>& info) { return info.param.name; }

// By day: light through a gap. The Cornell box has the walks of camera_motion_test.cpp.
std::vector<Case> dailyCases() {
  std::vector<Case> daily = kCases;
  std::erase_if(daily,
                [](const Case& one) { return one.name != std::string("door_ajar_indirect"); });
  return daily;
}

class Unbiased : public ::testing::TestWithParam<Case> {};
TEST_P(Unbiased, AgreesWithPath) { expectUnbiased(GetParam(), {128, 12, 4, 8, 2, 1}); }
INSTANTIATE_TEST_SUITE_P(Builtin, Unbiased, ::testing::ValuesIn(dailyCases()), caseName);

class UnbiasedNightly : public ::testing::TestWithParam<Case> {};
TEST_P(UnbiasedNightly, AgreesWithPath) { expectUnbiased(GetParam(), {512, 128, 32, 48, 8, 0}); }
INSTANTIATE_TEST_SUITE_P(Builtin, UnbiasedNightly, ::testing::ValuesIn(kCases), caseName);

// All paths, prefixes replayed. By day tests/canary asks this of the Cornell box.
class UnbiasedReplayNightly : public ::testing::TestWithParam<Case> {};
TEST_P(UnbiasedReplayNightly, AgreesWithPath) {
  expectUnbiased(GetParam(), {512, 128, 32, 48, 8, 0}, "restir_pt");
}
INSTANTIATE_TEST_SUITE_P(Builtin, UnbiasedReplayNightly, ::testing::ValuesIn(kCases), caseName);

// Direct light alone: the rest is that of `path`. By day among lamps of all sizes.
std::vector<Case> directCases() {
  std::vector<Case> cases = {{"many_lights", "many-lights", rl::RL_COMPONENT_DIRECT}};
  for (Case c : kCases) {
    if (c.name == std::string("door_ajar_indirect")) continue;
    c.components = rl::RL_COMPONENT_DIRECT;
    c.untestable = c.untestableOpen = std::max(c.untestable, c.untestableOpen);
    if (c.name != std::string("many_lights")) cases.push_back(c);
  }
  return cases;
}

TEST(UnbiasedDirect, AgreesWithPath) {
  expectUnbiased(directCases().front(), {128, 12, 4, 8, 2, 1}, "restir_di");
}
class UnbiasedDirectNightly : public ::testing::TestWithParam<Case> {};
TEST_P(UnbiasedDirectNightly, AgreesWithPath) {
  expectUnbiased(GetParam(), {512, 128, 32, 48, 8, 0}, "restir_di");
}
INSTANTIATE_TEST_SUITE_P(Builtin, UnbiasedDirectNightly, ::testing::ValuesIn(directCases()),
                         caseName);

}  // namespace
}  // namespace restlab::bias
