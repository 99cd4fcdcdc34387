// Effect of the reference's own noise on the numbers of a row: how much it widens the intervals of
// squared errors, and warnings for the reader.
#pragma once

#include <string>

#include "experiments/runner/reference/reference.h"
#include "experiments/statistics/bias_runs.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

// All 0 for a reference without halves, whose noise is part of every MSE.
struct ReferenceNoise {
  double varianceOfHalf = 0.0;  // mean over pixels and channels
  double common = 0.0;          // variance of its contribution to the MSE of all methods
  double commonAtLeast = 0.0;
  double shared = 0.0;  // variance of its contribution to the MSE of all runs of this method
};

ReferenceNoise noiseOf(const Reference& reference, const BiasRuns& runs);

// Returns the noise in the ratio of two methods' MSE against the same halves.
SharedNoise sharedNoise(const ReferenceNoise& numerator, const ReferenceNoise& denominator,
                        bool areSameImages = false);

// Flags an MSE below this many variances of a half. Its interval is still right, but only more
// samples of the reference narrow it, not more runs.
constexpr double kVariancesOfHalfMin = 4.0;
bool isNearNoise(double mse, const ReferenceNoise& noise);

// Flags relMSE, with or without its worst pixels, if it changes relatively by more than this when a
// half of the reference divides instead of the mean.
constexpr double kRelmseChangeMax = 0.05;

// Returns why relMSE of these runs depends on the reference's noise; "" if it does not, or if the
// reference has no halves.
std::string relmseFlag(const Reference& reference, const BiasRuns& runs);

}  // namespace restlab
