// Speed-ups on runs whose truth is known: where they are read, where not, and how often their
// intervals hold the truth.
#include "experiments/runner/tables/speed_up.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/runner/synthetic_runs.h"

namespace restlab {

namespace {

bool holds(const Interval& interval, double truth) {
  return interval.lo <= truth && truth <= interval.hi;
}

TEST(SpeedUp, ExactLines) {
  const auto up = speedUpOf(runsOf(1, {.scale = 8.0, .frameMs = 10.0}),
                            runsOf(1, {.scale = 1.0, .frameMs = 20.0}));
  ASSERT_TRUE(up.has_value());
  EXPECT_NEAR(up->equalTime.at, 640.0, 1e-9);
  EXPECT_NEAR(up->equalError.at, 0.125, 1e-9);
  for (const CurveReading& reading : {up->equalTime, up->equalError}) {
    EXPECT_NEAR(reading.ratio.value, 4.0, 1e-9) << "80 / t over 20 / t";
    EXPECT_NEAR(reading.measured.value, 4.0, 1e-9);
    EXPECT_FALSE(reading.isOffTheLines);
    EXPECT_EQ(reading.why, "");
  }
  EXPECT_FALSE(speedUpOf(runsOf(1, {}), std::vector<RunResult>(8)).has_value());
  auto untimed = runsOf(1, {});
  for (RunResult& run : untimed) {
    for (AccumulatedError& point : run.accumulated) point.timeMs = NAN;
  }
  EXPECT_FALSE(speedUpOf(untimed, untimed).has_value());
}

TEST(SpeedUp, IsReadInsideBothMeasuredRanges) {
  // The method's sixty-four frames end before the first frame of `path`.
  const auto apart = speedUpOf(runsOf(1, {.frameMs = 100.0}), runsOf(1, {.frameMs = 1.0}));
  EXPECT_TRUE(std::isnan(apart->equalTime.ratio.value));
  EXPECT_NE(apart->equalTime.why.find("outside the measured range"), std::string::npos);
  EXPECT_NEAR(apart->equalError.ratio.value, 100.0, 1e-9) << "the errors are the same";
  // The method's largest error is below the smallest of `path`.
  const auto lower = speedUpOf(runsOf(1, {.scale = 100.0}), runsOf(1, {.scale = 1.0}));
  EXPECT_TRUE(std::isnan(lower->equalError.ratio.value));
  EXPECT_NE(lower->equalError.why.find("outside the measured range"), std::string::npos);
  EXPECT_NEAR(lower->equalTime.ratio.value, 100.0, 1e-9);
  // No ratio is read where the line goes below all measured errors: the method falls from 1 to a
  // constant half, but its line continues to fall.
  const auto bent = speedUpOf(runsOf(1, {}), runsOf(1, {.scale = 0.5, .floor = 1.0}));
  EXPECT_NEAR(bent->equalError.at, 0.5 + 0.5 / 64.0, 1e-9);
}

TEST(SpeedUp, ErrorsThatDoNotFallAreNotReached) {
  for (const double slope : {0.0, 0.1}) {
    const auto standing = runsOf(1, {.slope = slope, .noise = 0.01});
    const auto up = speedUpOf(runsOf(2, {.noise = 0.01}), standing);
    EXPECT_TRUE(std::isnan(up->equalError.ratio.value));
    EXPECT_EQ(up->equalError.why, "its error does not fall");
    EXPECT_FALSE(std::isnan(up->equalTime.ratio.value)) << "which asks for no falling";
    const auto other = speedUpOf(standing, runsOf(2, {.noise = 0.01}));
    EXPECT_EQ(other->equalError.why, "the error of the baseline does not fall");
  }
}

TEST(SpeedUp, PointsInTheNoiseOfTheReferenceAreNotRead) {
  const auto path = runsOf(1, {.scale = 8.0}), method = runsOf(1, {.scale = 1.0});
  // 1, 0.5, 0.25, 0.125 of the method are above the noise: 8 frames.
  EXPECT_NEAR(speedUpOf(path, method, noiseBelow(0.1), noiseBelow(0.1))->equalTime.at, 8.0, 1e-9);
  const auto none = speedUpOf(path, method, noiseBelow(0.9), noiseBelow(0.9));
  EXPECT_NE(none->equalTime.why.find("fewer than two points"), std::string::npos);
  EXPECT_NE(none->equalError.why.find("fewer than two points"), std::string::npos);
}

TEST(SpeedUp, WhatTheLinesMissIsMeasured) {
  // Truth at 64 frames: 1 / 64 over 1 / 64 + 0.2. The fitted line is below the method's error.
  const auto up = speedUpOf(runsOf(1, {.noise = 0.01}), runsOf(2, {.noise = 0.01, .floor = 0.2}));
  EXPECT_TRUE(up->equalTime.isOffTheLines);
  EXPECT_NEAR(up->equalTime.measured.value, (1.0 / 64.0) / (1.0 / 64.0 + 0.2), 0.002);
  EXPECT_GT(up->equalTime.ratio.value, 1.2 * up->equalTime.measured.value);
}

// Over 1000 sets of runs of a correct estimator, with these seeds: at equal time 958 intervals held
// the truth, and 948 between the measured points; to equal error 961 and 948. 49 and 56 readings
// were reported as off their lines.
TEST(SpeedUp, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kSets = 1000;
  int time = 0, error = 0, timeMeasured = 0, errorMeasured = 0, timeOff = 0, errorOff = 0;
  for (uint32_t seed = 0; seed < kSets; ++seed) {
    // The lines are not parallel: the truth depends on where the ratio is read.
    const auto up = speedUpOf(
        runsOf(2 * seed, {.scale = 8.0, .frameMs = 10.0, .noise = 0.3}),
        runsOf(2 * seed + 1, {.scale = 1.0, .frameMs = 20.0, .slope = -0.8, .noise = 0.3}));
    const auto times = [&](double scale, double frameMs, double slope) {
      return frameMs * std::pow(up->equalError.at / scale, 1.0 / slope);
    };
    const double lower = 80.0 / up->equalTime.at / std::pow(up->equalTime.at / 20.0, -0.8);
    const double faster = times(8.0, 10.0, -1.0) / times(1.0, 20.0, -0.8);
    time += holds(up->equalTime.ratio, lower);
    error += holds(up->equalError.ratio, faster);
    timeMeasured += holds(up->equalTime.measured, lower);
    errorMeasured += holds(up->equalError.measured, faster);
    timeOff += up->equalTime.isOffTheLines;
    errorOff += up->equalError.isOffTheLines;
  }
  std::printf("    at equal time held %d, measured %d, off the lines %d of %d\n", time,
              timeMeasured, timeOff, kSets);
  std::printf("    to equal error held %d, measured %d, off the lines %d of %d\n", error,
              errorMeasured, errorOff, kSets);
  // 950 expected, and at most 50 off; four standard deviations of a binomial are 28.
  EXPECT_NEAR(time, 950, 28);
  EXPECT_NEAR(error, 950, 28);
  EXPECT_NEAR(timeMeasured, 950, 28);
  EXPECT_NEAR(errorMeasured, 950, 28);
  EXPECT_LE(timeOff, 78);
  EXPECT_LE(errorOff, 78);
}

}  // namespace

}  // namespace restlab
