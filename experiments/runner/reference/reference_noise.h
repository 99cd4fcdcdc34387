// What the reference's own noise does to the numbers of a row: how much wider it makes the
// intervals of its squared errors, and what a reader must be told.
#pragma once

#include <string>

#include "core/image/bias_runs.h"
#include "core/image/intervals.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

// All 0 for a reference without halves, whose noise is part of every MSE.
struct ReferenceNoise {
  double varianceOfHalf = 0.0;  // mean over pixels and channels
  double common = 0.0;          // variance of what it adds to the MSE of all methods
  double commonAtLeast = 0.0;
  double shared = 0.0;  // variance of what it adds to the MSE of all runs of this one
};

ReferenceNoise noiseOf(const Reference& reference, const BiasRuns& runs);

// Of the ratio of two methods' MSE against the same halves.
SharedNoise sharedNoise(const ReferenceNoise& numerator, const ReferenceNoise& denominator,
                        bool areSameImages = false);

// Below this many variances of a half an MSE is flagged. The interval is right there, too, but more
// samples of the reference would narrow it, not more runs.
constexpr double kVariancesOfHalfMin = 4.0;
bool isNearNoise(double mse, const ReferenceNoise& noise);

// Of relMSE, with and without its worst pixels: the largest relative change where a half of the
// reference divides instead of its mean. More than this is flagged.
constexpr double kRelmseChangeMax = 0.05;

// Why relMSE of these runs depends on the reference's noise; "" where it does not, or where the
// reference has no halves.
std::string relmseFlag(const Reference& reference, const BiasRuns& runs);

}  // namespace restlab
