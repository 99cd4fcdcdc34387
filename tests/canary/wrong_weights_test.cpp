// Deliberately wrong estimators that the bias test must reject. A test that has never rejected
// anything proves nothing; these are run with the method, the statistics and the effort of
// tests/bias.
#include <gtest/gtest.h>

#include "tests/bias/few_entries.h"
#include "tests/bias/independent_runs.h"
#include "tests/bias/test_cameras.h"

namespace restlab::bias {
namespace {

struct Canary {
  const char* name;
  const char* scene;
  std::vector<SceneCamera> cameras;  // none: the scene's own; of several the last frame is compared
  ParameterMap wrong;                // the error
  ParameterMap other;                // what makes it matter; with this alone the method is right
  const char* cache = "";            // the default
};

void PrintTo(const Canary& c, std::ostream* out) { *out << c.name; }

struct Effort {
  size_t runs;
  uint32_t truthFrames, frames, skipped;
  int threads;
};
constexpr Effort kEveryDay{128, 12, 8, 2, 1};
constexpr Effort kNightly{256, 24, 16, 4, 0};

// The wrong variant is rejected, and the same settings without the error are not.
void expectRejected(const Canary& canary, const Effort& effort) {
  const auto scene = builtinScene(canary.scene);
  const bool isWalk = canary.cameras.size() > 1;
  const auto frames = isWalk ? uint32_t(canary.cameras.size()) : effort.frames;
  const auto adapted = [&](Method method) {
    method.cameras = canary.cameras;
    method.config.threads = effort.threads;
    if (isWalk) method.skipped = frames - 1;
    return method;
  };
  Method truth = pathMethod(effort.truthFrames);
  truth.config.threads = effort.threads;
  if (!canary.cameras.empty()) truth.cameras = {canary.cameras.back()};
  const stats::Truth reference = stats::truthOf(independentRuns(scene, truth, 1, effort.runs));

  ParameterMap wrong = canary.other;
  wrong.insert(canary.wrong.begin(), canary.wrong.end());
  Method method = adapted(restirMethod(frames, effort.skipped, wrong));
  method.name = canary.name;
  method.config.cache = canary.cache;
  const stats::BiasReport rejected = testMethod(scene, method, reference, effort.runs);
  EXPECT_GT(rejected.confirmed, 0u) << canary.name << " was not rejected: " << rejected.text();

  method = adapted(restirMethod(frames, effort.skipped, canary.other));
  method.name = "the same without the error";
  method.config.cache = canary.cache;
  const stats::BiasReport accepted = testMethod(scene, method, reference, effort.runs);
  EXPECT_FALSE(accepted.failed()) << accepted.text();
}

// Donors from far away, whatever they look like: the more they differ, the more their weights
// matter.
ParameterMap farDonors() {
  return {{"spatial_neighbours", int64_t{2}},
          {"spatial_radius", 48.0},
          {"max_jacobian", 100.0},
          {"normal_threshold", -1.0},
          {"plane_threshold", 10.0}};
}

// Weights by confidence alone (1/M) ignore that a neighbour behind an occluder could never have
// produced the sample: darker.
Canary confidenceInTheBox() {
  return {"mis = confidence, cornell-box",
          "cornell-box",
          {cornellBelowTheLamp()},
          {{"mis", std::string("confidence")}},
          {}};
}
Canary confidenceBehindTheDoor() {
  return {"mis = confidence, door-ajar", "door-ajar", {}, {{"mis", std::string("confidence")}}, {}};
}

// Without the Jacobian of the reconnection, samples that come from afar are weighted as if they had
// been found here. The errors have both signs, so the cells matter more than the whole image.
Canary jacobianInTheBox() {
  return {"omit_jacobian, cornell-box",
          "cornell-box",
          {cornellBelowTheLamp()},
          {{"omit_jacobian", true}},
          farDonors()};
}
Canary jacobianBehindTheDoor() {
  return {"omit_jacobian, door-ajar", "door-ajar", {}, {{"omit_jacobian", true}}, farDonors()};
}

// A donor counts only where its sample, film sample included, is seen from here: confidences then
// depend on samples.
Canary donorsBySample() {
  return {"donors_by_sample, cornell-box",
          "cornell-box",
          {cornellBelowTheLamp()},
          {{"donors_by_sample", true}},
          farDonors()};
}

// A walk in which entries alone are merged over time, far ones among them.
Canary jacobianOf(const char* cache) {
  return {"omit_jacobian, cornell-box, entries",
          "cornell-box",
          walkTo(cornellBelowTheLamp(), 6, {0.06, 0.01, -0.05}, 0.0),
          {{"omit_jacobian", true}},
          {{"reproject", false},
           {"spatial_neighbours", int64_t{0}},
           {"feed_every", int64_t{1}},
           {"entry_proposals", int64_t{4}},
           {"entry_spread", 8.0},
           {kEntryCount, int64_t{4096}},
           {"max_jacobian", 100.0},
           {"normal_threshold", -1.0},
           {"plane_threshold", 10.0}},
          cache};
}

class CanaryOfEntries : public ::testing::TestWithParam<std::string> {};
TEST_P(CanaryOfEntries, AnOmittedJacobianIsRejected) {
  expectRejected(jacobianOf(GetParam().c_str()), kEveryDay);
}
INSTANTIATE_TEST_SUITE_P(Cache, CanaryOfEntries, ::testing::ValuesIn(cachesWithEntries()),
                         [](const auto& test) { return test.param; });

TEST(Canary, DonorsChosenByTheirSamplesAreRejected) { expectRejected(donorsBySample(), kEveryDay); }
TEST(Canary, ConfidenceWeightsAreRejected) { expectRejected(confidenceInTheBox(), kEveryDay); }
TEST(Canary, AnOmittedJacobianIsRejected) { expectRejected(jacobianInTheBox(), kEveryDay); }
TEST(Canary, AnOmittedJacobianIsRejectedBehindTheDoor) {
  expectRejected(jacobianBehindTheDoor(), kEveryDay);
}

class CanaryNightly : public ::testing::TestWithParam<Canary> {};
TEST_P(CanaryNightly, IsRejected) { expectRejected(GetParam(), kNightly); }
INSTANTIATE_TEST_SUITE_P(Wrong, CanaryNightly,
                         ::testing::Values(confidenceInTheBox(), confidenceBehindTheDoor(),
                                           jacobianInTheBox(), jacobianBehindTheDoor(),
                                           donorsBySample()));

}  // namespace
}  // namespace restlab::bias
