// Effect of the reference's noise on rows: wider intervals, flags, and a relMSE that does not count
// it as noise of the method.
#include "experiments/runner/reference/reference_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "experiments/runner/reference/reference_error.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

namespace {

constexpr uint32_t kSide = 32;

// Dark and bright pixels, as in a room; noise is relative to the light.
float truthOf(size_t pixel) { return pixel % 2 == 0 ? 0.05f : 1.0f; }

Image noisy(uint32_t seed, float deviation) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Image image(kSide, kSide);
  for (size_t p = 0; p < image.pixels.size(); ++p)
    image.pixels[p] = glm::vec3(truthOf(p) * (1.0f + deviation * normal(random)));
  return image;
}

Reference referenceOf(float deviationOfHalf) {
  Reference reference;
  reference.half0 = noisy(1, deviationOfHalf);
  reference.half1 = noisy(2, deviationOfHalf);
  reference.mean = Image(kSide, kSide);
  for (size_t p = 0; p < reference.mean.pixels.size(); ++p)
    reference.mean.pixels[p] = 0.5f * (reference.half0->pixels[p] + reference.half1->pixels[p]);
  reference.spp = 64;
  return reference;
}

struct Fixture {
  explicit Fixture(float deviationOfHalf, float deviationOfRuns = 0.5f) {
    suite.methods.resize(2);
    suite.timedFrames = 1;
    suite.methods[0].name = "path";
    suite.methods[0].session.mode = "unbiased";
    suite.methods[0].session.integrator = "path";
    suite.methods[1].name = "gi";
    suite.methods[1].session.integrator = "restir_gi";
    suite.methods[1].session.mode = "unbiased";
    block.width = block.height = kSide;
    block.reference = referenceOf(deviationOfHalf);
    block.methods.resize(2);
    for (size_t m = 0; m < 2; ++m) {
      for (uint32_t run = 0; run < 8; ++run) {
        const Image image = noisy(10 + 10 * uint32_t(m) + run, deviationOfRuns / (1.0f + float(m)));
        RunResult result;
        result.run = run;
        result.measured = measureFrame(image, block.reference, 0, {});
        result.passes = {{"pass", 1.0}};
        result.timesMs = {1.0};
        AccumulatedError point{1, 1.0, result.measured};
        result.accumulated.push_back(point);
        point.frames = 2;
        point.timeMs = 2.0;
        point.error.mse /= 100.0;
        result.accumulated.push_back(point);
        block.methods[m].measured.add(image);
        block.methods[m].runs.push_back(result);
      }
    }
  }
  Suite suite;
  BlockResult block;
};

bool hasFlag(const MethodSummary& row, const std::string& words) {
  for (const std::string& flag : row.flags) {
    if (flag.find(words) != std::string::npos) return true;
  }
  return false;
}

std::string flagsOf(const MethodSummary& row) {
  std::string all;
  for (const std::string& flag : row.flags) all += flag + "\n";
  return all;
}

TEST(ReferenceNoise, IntervalsOfARowHaveIt) {
  const Fixture fixture(0.5f);
  const auto rows = summarise(fixture.suite, fixture.block);
  std::vector<double> mse;
  for (const RunResult& run : fixture.block.methods[1].runs) mse.push_back(run.measured.mse);
  const Interval ofRuns = meanInterval(mse);
  const MethodSummary& gi = rows[1];
  ASSERT_GT(gi.noise.shared, 0.0);
  EXPECT_NEAR(gi.mse.hi, widened(ofRuns, gi.noise.shared).hi, 1e-12);
  EXPECT_GT(gi.mse.hi - gi.mse.lo, 1.2 * (ofRuns.hi - ofRuns.lo));
  // All intervals against the halves are widened.
  EXPECT_LT(gi.mseWithoutLights.lo, gi.mse.value);
  Fixture without(0.5f);
  without.block.reference.half0.reset();
  without.block.reference.half1.reset();
  for (MethodResult& method : without.block.methods) {
    for (RunResult& run : method.runs)
      run.measured.insideVarianceAtMost = run.measured.insideVarianceCommon = 0.0;
  }
  const MethodSummary unknown = summarise(without.suite, without.block)[1];
  EXPECT_EQ(unknown.noise.shared, 0.0) << "without halves the noise is in the MSE";
  EXPECT_NEAR(unknown.mse.hi, ofRuns.hi, 1e-12);
  EXPECT_LT(gi.mseRatio.lo, unknown.mseRatio.lo);
  EXPECT_GT(gi.mseRatio.hi, unknown.mseRatio.hi);
  EXPECT_LT(gi.efficiencyRatio.lo, unknown.efficiencyRatio.lo);
  EXPECT_LT(gi.mseRatioWithoutLights.lo, unknown.mseRatioWithoutLights.lo);
  EXPECT_LT(gi.convergence->points[1].mse.lo, unknown.convergence->points[1].mse.lo);
  EXPECT_EQ(rows[0].mseRatio.lo, 1.0) << "of path against itself";
}

// The reference's noise cancels for kernels of another feature mask, which render the same images.
TEST(ReferenceNoise, CancelsWhereImagesAreTheSame) {
  Fixture fixture(0.5f);
  fixture.block.methods[1] = fixture.block.methods[0];
  const MethodSummary same = summarise(fixture.suite, fixture.block)[1];
  ASSERT_GT(same.noise.shared, 0.0);
  for (const Interval& ratio : {same.mseRatio, same.mseRatioWithoutLights}) {
    EXPECT_NEAR(ratio.lo, 1.0, 1e-6);
    EXPECT_NEAR(ratio.hi, 1.0, 1e-6);
  }
}

TEST(ReferenceNoise, NearItRowsAreFlagged) {
  // Variance of gi: (0.5 / 2)^2 times the squared light; of a half: 0.5^2 or 0.05^2 times it.
  const Fixture near(0.5f), far(0.05f);
  const MethodSummary gi = summarise(near.suite, near.block)[1];
  EXPECT_TRUE(hasFlag(gi, "its MSE is 0.2")) << flagsOf(gi);
  EXPECT_TRUE(hasFlag(gi, "times the variance of a half of the reference (64 spp)")) << flagsOf(gi);
  EXPECT_TRUE(gi.counts);
  const auto rows = summarise(far.suite, far.block);
  EXPECT_FALSE(hasFlag(rows[1], "its MSE is ")) << flagsOf(rows[1]);
  EXPECT_TRUE(hasFlag(rows[1], "its MSE of 2 accumulated frames is ")) << flagsOf(rows[1]);
  EXPECT_FALSE(hasFlag(rows[1], "relMSE")) << flagsOf(rows[1]);
}

// The mean of the halves adds the reference's noise to the numerators, their product does not.
TEST(ReferenceNoise, RelativeErrorHasNoShareOfIt) {
  const Image image = noisy(7, 0.1f);
  const Reference good = referenceOf(0.001f), poor = referenceOf(0.1f);
  const double truth = errorAgainst("relmse_e1e-2", image, good).value;
  EXPECT_NEAR(errorAgainst("relmse_e1e-2", image, poor).value, truth, 0.1 * truth);
  EXPECT_GT(evaluateMetric("relmse_e1e-2", image, poor.mean).value, 1.3 * truth);
  const double trimmed = errorAgainst("relmse_e1e-2_trim0.1", image, good).value;
  EXPECT_NEAR(errorAgainst("relmse_e1e-2_trim0.1", image, poor).value, trimmed, 0.1 * trimmed);
  EXPECT_EQ(errorAgainst("relmse_e1e-2", image, poor).detail, "against the reference's two halves");
  // Same value as in `run`.
  EXPECT_EQ(measureFrame(image, poor, 0, {}).relmse,
            errorAgainst("relmse_e1e-2", image, poor).value);
  EXPECT_EQ(measureFrame(image, poor, 0, {}).relmseTrimmed,
            errorAgainst("relmse_e1e-2_trim0.1", image, poor).value);
  // Other programs' conventions and images of the reference itself keep their formulas.
  EXPECT_EQ(errorAgainst("relmse_tev", image, poor).value,
            evaluateMetric("relmse_tev", image, poor.mean).value);
  EXPECT_EQ(errorAgainst("relmse_e1e-2", poor.mean, poor).value, 0.0);
}

// The denominators still have noise: pixels that are too dark in one half.
TEST(ReferenceNoise, RelativeErrorThatHangsOnTheDivisorIsFlagged) {
  BiasRuns runs;
  for (uint32_t run = 0; run < 3; ++run) runs.add(noisy(50 + run, 0.5f));
  EXPECT_EQ(relmseFlag(referenceOf(0.05f), runs), "");
  const std::string flag = relmseFlag(referenceOf(0.8f), runs);
  EXPECT_NE(flag.find("relMSE depends on the reference's noise: "), std::string::npos) << flag;
  EXPECT_NE(flag.find(" % if its halves divide instead of their mean"), std::string::npos) << flag;
  EXPECT_NE(flag.find("without the worst pixels"), std::string::npos) << flag;
  Reference whole = referenceOf(0.8f);
  whole.half0.reset();
  whole.half1.reset();
  EXPECT_EQ(relmseFlag(whole, runs), "");
}

// Leaving out the worst 0.1 % of few pixels changes nothing: equal numbers are printed once.
TEST(ReferenceNoise, ChangesThatAgreeAreSaidOnce) {
  Reference reference;
  reference.mean = Image(4, 4, glm::vec3(1.0f));
  reference.half0 = Image(4, 4, glm::vec3(1.5f));
  reference.half1 = Image(4, 4, glm::vec3(0.5f));
  BiasRuns runs;
  for (const float value : {3.0f, 4.0f, 5.0f}) runs.add(Image(4, 4, glm::vec3(value)));
  const std::string flag = relmseFlag(reference, runs);
  ASSERT_NE(flag, "");
  EXPECT_NE(flag.find(", with the worst pixels and without"), std::string::npos) << flag;
  EXPECT_EQ(flag.find(" % and "), flag.rfind(" % and ")) << flag;
}

}  // namespace

}  // namespace restlab
