// Fitted lines on runs whose truth is known: how often the intervals hold it, and how often a line
// is rejected as a fit.
#include "experiments/runner/tables/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/tables/accumulated_curve.h"
#include "experiments/runner/tables/speed_up.h"
#include "tests/runner/synthetic_runs.h"

namespace restlab {

namespace {

TEST(Convergence, ExactLines) {
  const auto curve = convergenceOf(runsOf(1, {.scale = 8.0, .frameMs = 10.0}));
  ASSERT_TRUE(curve.has_value());
  ASSERT_EQ(curve->points.size(), 7u);
  EXPECT_NEAR(curve->slope.value, -1.0, 1e-12);
  EXPECT_NEAR(curve->slope.lo, -1.0, 1e-9);
  EXPECT_NEAR(curve->points[6].timeMs, 640.0, 1e-9);
  EXPECT_NEAR(std::exp(curve->intercept), 80.0, 1e-9) << "8 / frames is 80 / time";
  EXPECT_NEAR(curve->misfit, 0.0, 1e-12);
  EXPECT_FALSE(curve->isNoLine);
  EXPECT_EQ(curve->fitted(), 7u);
}

TEST(Convergence, WhatIsNotAboveTheNoiseIsNotFitted) {
  auto runs = runsOf(1, {.scale = 8.0, .frameMs = 10.0});
  for (size_t i = 0; i < runs.size(); ++i)
    runs[i].accumulated.back().error.mse = i % 2 == 0 ? 0.5 : -0.5;
  const auto curve = convergenceOf(runs);
  EXPECT_FALSE(curve->points.back().isFitted);
  EXPECT_EQ(curve->fitted(), 6u);
  EXPECT_NEAR(curve->slope.value, -1.0, 1e-12);
  // 8, 4, 2, 1, 0.5, 0.25: the last two are below the reference's noise.
  EXPECT_EQ(convergenceOf(runs, noiseBelow(0.5))->fitted(), 4u);
  EXPECT_FALSE(convergenceOf(std::vector<RunResult>(3)).has_value()) << "nothing was accumulated";
  EXPECT_FALSE(convergenceOf({}).has_value());
  const auto one = convergenceOf(runsOf(1, {.scale = 8.0, .frameMs = 10.0, .runs = 1}));
  EXPECT_TRUE(std::isnan(one->slope.lo)) << "one run has no interval";
  EXPECT_EQ(one->fitted(), 7u);
}

// A large spread of the runs does not count as noise of the reference, even if the interval holds
// 0.
TEST(Convergence, SpreadOfRunsLeavesNoPointOut) {
  auto runs = runsOf(1, {.scale = 8.0, .frameMs = 10.0});
  for (AccumulatedError& point : runs[0].accumulated) point.error.mse *= 100.0;
  const auto curve = convergenceOf(runs);
  EXPECT_LT(curve->points[0].mse.lo, 0.0);
  EXPECT_EQ(curve->fitted(), 7u);
  EXPECT_NEAR(curve->slope.value, -1.0, 1e-12);
}

TEST(Convergence, FallingIsWhatTheIntervalSays) {
  EXPECT_TRUE(isFalling({-0.5, -0.6, -0.4}));
  EXPECT_FALSE(isFalling({-0.5, -1.1, 0.1}));
  EXPECT_FALSE(isFalling({0.1, 0.0, 0.2}));
  EXPECT_TRUE(isFalling({-0.5, NAN, NAN}));
  EXPECT_FALSE(isFalling({0.5, NAN, NAN}));
  EXPECT_FALSE(isFalling({NAN, NAN, NAN}));
}

TEST(Convergence, CurvesThatAreNoLinesAreSaid) {
  // Falls fast, then stays constant, like frames that share their samples.
  const auto bent = convergenceOf(runsOf(1, {.noise = 0.02, .floor = 0.2}));
  EXPECT_TRUE(bent->isNoLine);
  EXPECT_GT(bent->misfit, 0.08) << "a fifth";
  // A bend smaller than the spread of the runs cannot be seen.
  EXPECT_FALSE(convergenceOf(runsOf(1, {.noise = 2.0, .floor = 0.01}))->isNoLine);
  // A bend below 5 % does not matter, however precisely it is known.
  EXPECT_FALSE(convergenceOf(runsOf(1, {.noise = 1e-6, .floor = 1e-3}))->isNoLine);
}

TEST(AccumulatedCurve, InterpolatesBetweenItsPoints) {
  const AccumulatedCurve curve = {{0, 0.0, 4.0}, {1, 1.0, 3.0}, {2, 3.0, -1.0}};
  EXPECT_NEAR(interpolatedError(curve, 0.25), 3.75, 1e-12);
  EXPECT_NEAR(interpolatedError(curve, 2.0), 1.0, 1e-12);
  EXPECT_NEAR(interpolatedError(curve, 3.5), -2.0, 1e-12) << "beyond: as the last two go";
  EXPECT_NEAR(interpolatedTime(curve, 3.75), 0.25, 1e-12);
  EXPECT_NEAR(interpolatedTime(curve, 1.0), 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(interpolatedTime({{0, 0.0, 4.0}, {1, 1.0, 5.0}}, 3.0))) << "rises";
  EXPECT_TRUE(std::isnan(interpolatedError({{0, 0.0, 4.0}}, 0.0)));
}

// Over 1000 sets of runs of a correct estimator, with these seeds: the slope's interval held the
// truth 955 times, and a line was rejected as a fit 54 times.
TEST(Convergence, IntervalsHoldTheTruthAsOftenAsTheySay) {
  int slopes = 0, none = 0;
  constexpr int kSets = 1000;
  for (uint32_t seed = 0; seed < kSets; ++seed) {
    const auto curve = convergenceOf(runsOf(seed, {.scale = 8.0, .noise = 0.3}));
    slopes += curve->slope.lo <= -1.0 && -1.0 <= curve->slope.hi;
    none += curve->isNoLine;
  }
  std::printf("    slope held %d, called no line %d of %d\n", slopes, none, kSets);
  // 950 and at most 50 expected; four standard deviations of a binomial are 28.
  EXPECT_NEAR(slopes, 950, 28);
  EXPECT_LE(none, 78);
}

// The reference's noise moves all points of all runs of both methods by the same amount: here by a
// third of the last error of the second method. Over 1000 sets slope and speed-up held the truth in
// 96.4 and 96.7 %; with the jackknife alone in 35.7 and 39.1 %.
TEST(Convergence, IntervalsKnowOfTheReferencesNoise) {
  constexpr int kSets = 1000;
  constexpr double kNoise = 0.005;
  const AccumulatedNoise noise{kNoise * kNoise, true};
  int slopes = 0, ratios = 0, slopesWithout = 0, ratiosWithout = 0;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (uint32_t seed = 0; seed < kSets; ++seed) {
    auto path = runsOf(2 * seed, {.scale = 8.0, .frameMs = 10.0, .noise = 0.1});
    auto method = runsOf(2 * seed + 1, {.scale = 1.0, .frameMs = 20.0, .noise = 0.1});
    const double moved = kNoise * normal(random);
    for (auto* runs : {&path, &method}) {
      for (RunResult& run : *runs) {
        for (AccumulatedError& point : run.accumulated) point.error.mse += moved;
      }
    }
    const auto holds = [](const Interval& interval, double truth) {
      return interval.lo <= truth && truth <= interval.hi;
    };
    slopes += holds(convergenceOf(method, noise)->slope, -1.0);
    slopesWithout += holds(convergenceOf(method)->slope, -1.0);
    ratios += holds(speedUpOf(path, method, noise, noise)->equalTime.ratio, 4.0);
    ratiosWithout += holds(speedUpOf(path, method)->equalTime.ratio, 4.0);
  }
  std::printf("    slope held %d (%d without), speed-up held %d (%d without) of %d\n", slopes,
              slopesWithout, ratios, ratiosWithout, kSets);
  EXPECT_GE(slopes, 930);
  EXPECT_GE(ratios, 930);
}

// For a biased method the bound of its runs counts; if older lines lack it, the interval is
// unknown.
TEST(Convergence, BoundOfRunsWhereTheMethodIsBiased) {
  auto runs = runsOf(1, {.scale = 8.0, .frameMs = 10.0});
  for (RunResult& run : runs) run.accumulated[0].error.mseVarianceAtMost = 0.04;
  const double z = 1.959963984540054;
  EXPECT_NEAR(convergenceOf(runs, {0.01, true})->points[0].mse.hi, 8.0 + z * 0.1, 1e-9);
  EXPECT_NEAR(convergenceOf(runs, {0.01, false})->points[0].mse.hi, 8.0 + z * 0.2, 1e-9);
  EXPECT_NEAR(convergenceOf(runs, {0.09, false})->points[0].mse.hi, 8.0 + z * 0.3, 1e-9);
  EXPECT_NEAR(convergenceOf(runs)->points[0].mse.hi, 8.0, 1e-9);
  runs[3].accumulated[0].error.mseVarianceAtMost = std::nan("");
  EXPECT_TRUE(std::isnan(convergenceOf(runs, {0.01, false})->points[0].mse.hi));
}

}  // namespace

}  // namespace restlab
