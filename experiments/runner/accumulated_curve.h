// Mean error of accumulated frames over time, in natural logarithms: the line through it, and where
// the measured points themselves stand.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "experiments/runner/experiment.h"

namespace restlab {

struct CurvePoint {
  size_t index = 0;  // among the run's accumulations
  double logTime = 0.0, logMse = 0.0;
};

// In order of time.
using AccumulatedCurve = std::vector<CurvePoint>;

// Of the mean over these runs. Left out is what has no logarithm, and what is not above
// `leastMse`: the noise of the reference, which all runs share and no interval over them knows.
AccumulatedCurve accumulatedCurve(const std::vector<RunResult>& runs,
                                  std::span<const size_t> chosen, double leastMse);

struct CurveLine {
  double slope = std::numeric_limits<double>::quiet_NaN();
  double intercept = std::numeric_limits<double>::quiet_NaN();
  double at(double logTime) const { return intercept + slope * logTime; }
  double reaches(double logMse) const { return (logMse - intercept) / slope; }
};

// Least squares; NaN with fewer than two times.
CurveLine fitLine(const AccumulatedCurve& curve);

// Between the measured points along straight lines, beyond them along the last; NaN with fewer than
// two points.
double interpolatedError(const AccumulatedCurve& curve, double logTime);
// The first time at which that is not above `logMse`; NaN where it never comes to it.
double interpolatedTime(const AccumulatedCurve& curve, double logMse);

}  // namespace restlab
