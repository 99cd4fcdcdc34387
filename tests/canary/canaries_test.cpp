// Deliberately wrong estimators that the certificate must call biased: a test that never rejects
// proves nothing. Each is tried where its mistake matters; the same settings without it must not be
// called biased.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/certificate/certificate.h"
#include "experiments/statistics/power.h"
#include "tests/bias/few_entries.h"
#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"
#include "tests/canary/wrong_kernels.h"

namespace restlab::canary {
namespace {

using bias::Method;
using certificate::Certificate;
using certificate::Evidence;
using certificate::Verdict;

constexpr uint32_t kFirstBatch = 10'000'000, kFreshBatch = 20'000'000, kTruth = 30'000'000;
constexpr double kPower = 0.9;

struct Effort {
  size_t runs;
  uint32_t truthFrames;  // per half
  int threads;
};
constexpr Effort kEveryDay{128, 1024, 1};
constexpr Effort kObvious{32, 32, 1};   // for a mistake of a fifth of some cells
constexpr Effort kSmall{192, 1024, 1};  // for a mistake of a few percent of some cells
constexpr Effort kNightly{256, 8192, 0};

// Rendered scene and method, and the scene with the light of the frames that count.
struct Setting {
  std::shared_ptr<const CompiledScene> scene, lightAtLast;
  Method method;
  std::string truth = "path";  // integrator of the reference
};

Image meanOf(const Setting& setting, uint32_t seed, const Effort& effort) {
  Method path = bias::pathMethod(effort.truthFrames);
  path.config.integrator = setting.truth;
  path.config.threads = effort.threads;
  path.config.width = setting.method.config.width;
  path.config.height = setting.method.config.height;
  path.config.components = setting.method.config.components;
  if (!setting.method.cameras.empty()) path.cameras = {setting.method.cameras.back()};
  Image mean;
  bias::forEachRun(setting.lightAtLast, path, seed, 1, [&](const Image& image) { mean = image; });
  return mean;
}

// Returns the probability that a first and a fresh batch both reject the clearest cell, if its bias
// is as measured.
double powerOf(const Certificate& c) {
  const certificate::Rules rules;
  double family = 0.0, power = 0.0;
  for (const stats::CellVerdict& v : c.cells.cells) family += v.testable;
  for (const stats::CellVerdict& v : c.cells.cells) {
    if (!v.confirmed || !(v.welch.standardError > 0.0)) continue;
    const double once = stats::testPower(std::abs(v.welch.difference), v.welch.standardError,
                                         v.welch.dof, rules.familyError / family);
    power = std::max(power, once * once);
  }
  return power;
}

// A setting with its reference.
class Trial {
 public:
  Trial(Setting setting, const Effort& effort) : setting_(std::move(setting)), effort_(effort) {
    setting_.method.config.threads = effort.threads;
    reference_.half0 = meanOf(setting_, kTruth, effort);
    reference_.half1 = meanOf(setting_, kTruth + 1, effort);
    reference_.mean = *reference_.half0;
    for (size_t p = 0; p < reference_.mean.pixels.size(); ++p)
      reference_.mean.pixels[p] =
          0.5f * (reference_.half0->pixels[p] + reference_.half1->pixels[p]);
  }

  // Uses the currently registered kernels.
  Certificate certify(const ParameterMap& more = {}) const {
    const Evidence first = batch(kFirstBatch, more);
    return certificate::judge(first, first.runs(), [&] { return batch(kFreshBatch, more).runs(); },
                              reference_, {});
  }

  void expectRejected(const std::string& name, const Certificate& c) const {
    const double power = powerOf(c);
    const Interval& bias = c.image.front().bias;
    std::printf("canary %s: %s, %s; luminance %+.2f %% [%+.2f, %+.2f]; power %.3f\n", name.c_str(),
                certificate::verdictName(c.verdict), c.reason.c_str(), 100.0 * bias.value,
                100.0 * bias.lo, 100.0 * bias.hi, power);
    std::fflush(stdout);
    EXPECT_EQ(c.verdict, Verdict::biased) << name;
    EXPECT_GE(power, kPower) << name;
  }
  void expectCanary(const std::string& name) const {
    const WrongKernels wrong(name);
    expectRejected(name, certify());
  }
  void expectRight(const ParameterMap& more = {}) const {
    const Certificate c = certify(more);
    std::printf("without a mistake: %s, %s\n", certificate::verdictName(c.verdict),
                c.reason.c_str());
    EXPECT_NE(c.verdict, Verdict::biased) << c.reason;
  }

 private:
  Evidence batch(uint32_t firstSeed, const ParameterMap& more) const {
    Method method = setting_.method;
    for (const auto& [name, value] : more) method.config.parameters[name] = value;
    Evidence evidence(method.config.width, method.config.height);
    bias::forEachRun(setting_.scene, method, firstSeed, effort_.runs,
                     [&](const Image& run) { evidence.add(run); });
    return evidence;
  }

  Setting setting_;
  Effort effort_;
  Reference reference_;
};

// Distant donors of any similarity: the more they differ, the more their weights matter.
ParameterMap farDonors() {
  return {{"spatial_neighbours", int64_t{2}},
          {"spatial_radius", 48.0},
          {"max_jacobian", 100.0},
          {"normal_threshold", -1.0},
          {"plane_threshold", 10.0}};
}

Setting still(const char* scene, const ParameterMap& parameters) {
  Setting s;
  s.scene = s.lightAtLast = bias::builtinScene(scene);
  s.method = bias::restirMethod(8, 2, parameters);
  return s;
}
Setting belowTheLamp(const ParameterMap& parameters) {
  Setting s = still("cornell-box", parameters);
  s.method.cameras = {bias::cornellBelowTheLamp()};
  return s;
}
// A moving camera; only the last frame counts.
Setting walking(const ParameterMap& parameters) {
  Setting s = still("cornell-box", parameters);
  s.method = bias::restirMethod(6, 5, parameters);
  s.method.cameras = bias::walkTo(bias::cornellBelowTheLamp(), 6, {0.06, 0.01, -0.05}, 0.0);
  return s;
}
// A moving camera with temporal reuse only from entries, distant ones included.
Setting walkingWithEntries(const std::string& cache) {
  Setting s = walking({{"reproject", false},
                       {"spatial_neighbours", int64_t{0}},
                       {"feed_every", int64_t{1}},
                       {"entry_proposals", int64_t{4}},
                       {"entry_spread", 8.0},
                       {kEntryCount, int64_t{4096}},
                       {"max_jacobian", 100.0},
                       {"normal_threshold", -1.0},
                       {"plane_threshold", 10.0}});
  s.method.config.cache = cache;
  return s;
}
// The lamp is dimmed before the last frame but one; the last one counts. With this
// validate_response any change of light discards the history.
Setting dimmed() {
  constexpr uint32_t kFrames = 10;
  Setting s = still("cornell-box", {{"validate_every", int64_t{1}}, {"validate_response", 1000.0}});
  s.lightAtLast =
      CompiledScene::build(withLightFactor(makeBuiltinScene("cornell-box"), kAllLights, 0.5));
  s.method.frames = kFrames;
  s.method.skipped = kFrames - 1;
  s.method.before = [bright = s.scene, dim = s.lightAtLast](Session& session, uint32_t frame) {
    if (frame == 0) session.setScene(bright);
    if (frame == kFrames - 2) session.setScene(dim);
  };
  return s;
}

// Prefixes are replayed: x2 connects only where the ray to it stands for a large area.
Setting replayed() {
  Setting s = belowTheLamp(farDonors());
  s.method.config.integrator = "restir_pt";
  s.method.config.components = rl::RL_COMPONENT_INDIRECT;
  s.method.config.parameters["connect_footprint"] = 1.0;
  s.method.config.parameters["spatial_neighbours"] = int64_t{3};
  s.method.config.parameters["spatial_radius"] = 8.0;
  return s;
}

Setting replayedWalk() {
  Setting s = walking({});
  s.method.config.integrator = "restir_pt";
  s.method.config.parameters["connect_footprint"] = 1.0;
  return s;
}

const ParameterMap kConfidence = {{"mis", std::string("confidence")}};

// Canaries for a still view with distant donors.
const std::vector<std::string> kOfWeights = {"empty_inputs_dropped", "failed_shifts_dropped",
                                             "jacobian_left_out", "light_density_of_the_source",
                                             "random_dimension_reused"};

const std::vector<std::string> kOfNearDonors = {"jacobian_inverted"};
const std::vector<std::string> kOfFilm = {"confidence_by_film_sample"};
const std::vector<std::string> kOfWalks = {"visibility_missing_in_mis"};
const std::vector<std::string> kOfReplay = {"replay_not_invertible", "pair_tested_on_one_side",
                                            "density_left_in_the_integrand"};
// A replay with random numbers of the destination, there and back, is no mistake but noise: target
// and MIS weights then agree on whatever path it finds.
const std::vector<std::string> kOfReplayedWalks = {"replay_with_another_key"};
const std::vector<std::string> kOfChangingLight = {"stale_target"};

void tryAll(const Trial& trial, const std::vector<std::string>& canaries) {
  trial.expectRight();
  for (const std::string& name : canaries) trial.expectCanary(name);
}

void tryWeights(const Effort& effort) {
  tryAll(Trial(belowTheLamp(farDonors()), effort), kOfWeights);
}
// Uses the default donors: with distant ones an inverted Jacobian makes noise too skewed to test.
void tryNear(const Effort& effort) {
  const Trial trial(belowTheLamp({}), effort);
  tryAll(trial, kOfNearDonors);
  trial.expectRejected("mis = confidence", trial.certify(kConfidence));
}
void tryFilm(const Effort& effort) { tryAll(Trial(still("cornell-box", {}), effort), kOfFilm); }
void tryWalking(const Effort& effort) { tryAll(Trial(walking({}), effort), kOfWalks); }
void tryEntries(const Effort& effort, const std::string& cache) {
  const Trial trial(walkingWithEntries(cache), effort);
  trial.expectRight();
  trial.expectCanary("jacobian_left_out");
}
void tryChangingLight(const Effort& effort) { tryAll(Trial(dimmed(), effort), kOfChangingLight); }

// By day one mistake of each kind: over space, over time, in light that changes. Those of entries,
// over the same kernels, are tried by night.
TEST(Canary, AWrongWeightIsRejected) {
  tryAll(Trial(belowTheLamp(farDonors()), kEveryDay), {kOfWeights.front()});
}
TEST(Canary, MissingVisibilityIsRejected) { tryWalking(kEveryDay); }

TEST(Canary, AReplayWithoutAnInverseIsRejected) {
  tryAll(Trial(replayed(), kEveryDay), {kOfReplay.front()});
}
TEST(Canary, NightlyWrongReplaysAreRejected) { tryAll(Trial(replayed(), kNightly), kOfReplay); }
TEST(Canary, NightlyAReplayWithAnotherKeyIsRejected) {
  tryAll(Trial(replayedWalk(), kNightly), kOfReplayedWalks);
}

TEST(Canary, NightlyWrongWeightsAreRejected) { tryWeights(kNightly); }
TEST(Canary, NightlyWrongWeightsOfNearDonorsAreRejected) { tryNear(kNightly); }
TEST(Canary, NightlyConfidenceByTheFilmSampleIsRejected) { tryFilm(kNightly); }
TEST(Canary, NightlyMissingVisibilityIsRejected) { tryWalking(kNightly); }
TEST(Canary, NightlyAStaleTargetIsRejected) { tryChangingLight(kNightly); }
TEST(Canary, NightlyBehindTheDoor) {
  const Trial trial(still("door-ajar", farDonors()), kNightly);
  trial.expectRight();
  trial.expectCanary("jacobian_left_out");
  trial.expectRejected("mis = confidence", trial.certify(kConfidence));
}

class CanaryOfEntries : public ::testing::TestWithParam<std::string> {};
TEST_P(CanaryOfEntries, AnOmittedJacobianIsRejected) { tryEntries(kSmall, GetParam()); }
const auto kNameOf = [](const auto& test) { return test.param; };
INSTANTIATE_TEST_SUITE_P(Nightly, CanaryOfEntries, ::testing::ValuesIn(bias::cachesWithEntries()),
                         kNameOf);

// Without a cap the mean is right, but its variance is not: a mean of running means has twice the
// variance of a mean.
TEST(Canary, NightlyHistoriesWithoutACapAreSeenInTheVarianceOfALongMean) {
  constexpr uint32_t kFrames = 256;
  constexpr size_t kRuns = 24;
  Setting setting = still("cornell-box", {});
  setting.method = bias::restirMethod(kFrames, 0);
  setting.method.config.width = 32;
  setting.method.config.height = 18;
  const auto variance = [&] {
    BiasRuns runs;
    bias::forEachRun(setting.scene, setting.method, kFirstBatch, kRuns,
                     [&](const Image& run) { runs.add(run); });
    return runs.variance();
  };
  const Interval right = variance();
  const WrongKernels kernels("no_cap");
  const Interval wrong = variance();
  std::printf(
      "canary no_cap: variance of a mean of %u frames %.3g [%.3g, %.3g], with the cap %.3g "
      "[%.3g, %.3g]\n",
      kFrames, wrong.value, wrong.lo, wrong.hi, right.value, right.lo, right.hi);
  EXPECT_GT(wrong.lo, 1.2 * right.hi);
}

// A room with the camera in it.
builtin::SceneBuilder room(const std::string& name) {
  builtin::SceneBuilder scene(name);
  scene.add(builtin::insideOut(builtin::box("room", {-2.0, 0.0, -3.0}, {2.0, 3.0, 2.0})),
            scene.addMaterial("wall", builtin::lambert({0.7f, 0.6f, 0.5f})));
  scene.addCamera("front", {0.3, 1.6, 1.7}, {0.0, 1.2, -1.5}, 60.0);
  return scene;
}

void addLamp(builtin::SceneBuilder& scene, double z) {
  scene.add(builtin::quad("lamp", {-0.3, 2.6, z}, {0.6, 0.0, 0.0}, {0.0, 0.0, 0.8}),
            scene.addMaterial("lamp", builtin::lamp({6.0f, 5.0f, 4.0f})));
}

// A lamp behind the camera and an equal one before it.
Scene twoLamps() {
  builtin::SceneBuilder scene = room("two lamps");
  addLamp(scene, 1.0);
  addLamp(scene, -2.0);
  return scene.finish();
}

// A room under coloured water, lamp and camera too. A frosted pane without thickness stands before
// most of it.
Scene paneInWater() {
  builtin::SceneBuilder scene = room("pane in water");
  addLamp(scene, -2.0);
  scene.add(builtin::box("water", {-3.0, -1.0, -4.0}, {3.0, 4.0, 3.0}),
            scene.addMaterial("water", builtin::glass(0.0f, {0.4f, 0.2f, 0.1f})));
  rl::Material pane = builtin::glass(0.5f, glm::vec3(0.0f));
  pane.flags |= rl::RL_MATERIAL_THIN | rl::RL_MATERIAL_DOUBLE_SIDED;
  scene.add(builtin::quad("pane", {-1.2, 0.3, -0.3}, {2.4, 0.0, 0.0}, {0.0, 2.2, 0.0}),
            scene.addMaterial("pane", pane));
  return scene.finish();
}

// A mistake that all techniques of `path` share is in its reference, too: only that of `bdpt` shows
// it. Where `bdpt` includes the changed file, it has the change, and is right all the same.
void expectSeenByBdpt(const std::string& canary,
                      const std::shared_ptr<const CompiledScene>& scene) {
  Setting setting;
  setting.scene = setting.lightAtLast = scene;
  setting.method = bias::pathMethod(8);
  Setting other = setting;
  other.truth = "bdpt";
  std::optional<Trial> trial;
  {
    const WrongKernels wrong(canary);
    Trial(setting, kObvious).expectRight();
    trial.emplace(other, kObvious);
    trial->expectRejected(canary, trial->certify());
  }
  trial->expectRight();
}
TEST(Canary, AMistakeOfPathIsSeenByBdpt) {
  expectSeenByBdpt("half_density_of_lamps", bias::builtinScene("cornell-box"));
}
TEST(Canary, ALampDrawnTooRarelyIsSeenByBdpt) {
  expectSeenByBdpt("lamp_drawn_too_rarely", CompiledScene::build(twoLamps()));
}
TEST(Canary, ForgottenAbsorptionIsSeenByBdpt) {
  expectSeenByBdpt("absorption_forgotten_behind_sheets", CompiledScene::build(paneInWater()));
}

// Checks that every patch is used by a test.
TEST(Canary, EveryOneIsTried) {
  // Tested by the variance of a long mean, against bdpt, and in extremes_test.cpp.
  std::set<std::string> tried = {"no_cap",
                                 "absolute_epsilon",
                                 "clamp_at_1e3",
                                 "fixed_ray_offset",
                                 "half_density_of_lamps",
                                 "lamp_drawn_too_rarely",
                                 "absorption_forgotten_behind_sheets"};
  for (const auto* canaries : {&kOfWeights, &kOfNearDonors, &kOfFilm, &kOfWalks, &kOfReplay,
                               &kOfReplayedWalks, &kOfChangingLight})
    tried.insert(canaries->begin(), canaries->end());
  const std::vector<std::string> all = canaryNames();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()), tried);
  EXPECT_THROW(WrongKernels("no such canary"), std::invalid_argument);
}

}  // namespace
}  // namespace restlab::canary
