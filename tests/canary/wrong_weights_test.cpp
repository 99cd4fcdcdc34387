// Deliberately wrong estimators that the bias test must reject. A test that has never rejected
// anything proves nothing; these are run with the method, the statistics and the effort of tests/bias.
#include <gtest/gtest.h>

#include "tests/bias/independent_runs.h"

namespace restlab::bias {
namespace {

struct Canary {
  const char* scene;
  ParameterMap wrong;  // the error
  ParameterMap other;  // what makes it matter; with this alone the method is right
  size_t runs;
  uint32_t truthFrames, frames, skipped;
};

// The wrong variant is rejected, and the same settings without the error are not.
void expectRejected(const Canary& canary, const std::string& name) {
  const auto scene = builtinScene(canary.scene);
  const stats::Truth reference =
      stats::truthOf(independentRuns(scene, pathMethod(canary.truthFrames), 1, canary.runs));

  ParameterMap wrong = canary.other;
  wrong.insert(canary.wrong.begin(), canary.wrong.end());
  Method method = restirMethod(canary.frames, canary.skipped, wrong);
  method.name = name;
  const stats::BiasReport rejected = testMethod(scene, method, reference, canary.runs);
  EXPECT_GT(rejected.confirmed, 0u) << name << " was not rejected: " << rejected.text();

  method = restirMethod(canary.frames, canary.skipped, canary.other);
  method.name = "the same without the error";
  const stats::BiasReport accepted = testMethod(scene, method, reference, canary.runs);
  EXPECT_FALSE(accepted.failed()) << accepted.text();
}

// Weights by confidence alone (1/M) ignore that a neighbour behind the door's edge could never have
// produced the sample: darker.
TEST(Canary, ConfidenceWeightsAreRejected) {
  expectRejected({"door-ajar", {{"mis", std::string("confidence")}}, {}, 128, 16, 12, 4},
                 "mis = confidence");
}

// Without the Jacobian of the reconnection, samples that come from afar are weighted as if they had
// been found here. The errors have both signs, so the cells matter more than the whole image.
TEST(Canary, AnOmittedJacobianIsRejected) {
  expectRejected({"door-ajar",
                  {{"omit_jacobian", true}},
                  {{"spatial_neighbours", int64_t{2}},
                   {"spatial_radius", 48.0},
                   {"normal_threshold", -1.0},
                   {"plane_threshold", 10.0}},
                  128, 16, 12, 4},
                 "omit_jacobian");
}

}  // namespace
}  // namespace restlab::bias
