// Mean error of accumulated frames over time, in natural logarithms: the line through it, and where
// the measured points themselves stand.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/run/experiment.h"

namespace restlab {

// What the reference's noise adds to all runs of a method, in points of an accumulation.
struct AccumulatedNoise {
  double common = 0.0;  // variance in the MSE of every unbiased method
  // Images of accumulations are not kept, so that of another one only an upper bound is known, that
  // of its runs (FrameError::mseVarianceAtMost).
  bool isUnbiased = true;
};

// Its variance in an accumulation of these runs; NaN where lines of older programs lack it.
double varianceOfPoint(const std::vector<RunResult>& runs, std::span<const size_t> chosen,
                       size_t point, const AccumulatedNoise& noise);

// Errors that are not above so many standard deviations of it are not fitted.
constexpr double kNoiseOfFittedErrors = 4.0;

struct CurvePoint {
  size_t index = 0;  // among the run's accumulations
  double logTime = 0.0, logMse = 0.0;
};

// In order of time.
using AccumulatedCurve = std::vector<CurvePoint>;

// Of the mean over these runs, moved by so many standard deviations of the reference's noise. Left
// out is what has no logarithm and, unmoved, what is not above kNoiseOfFittedErrors of them.
AccumulatedCurve accumulatedCurve(const std::vector<RunResult>& runs,
                                  std::span<const size_t> chosen, const AccumulatedNoise& noise,
                                  double deviations = 0.0);

// 0, 1, 2, ...: all of the runs.
std::vector<size_t> everyRun(size_t runs);

// Intervals of statistics of curves: the jackknife's over runs, and what one standard deviation of
// the reference's noise, up or down, moves, added as widened() does.
using CurveStatistics =
    std::function<std::vector<double>(std::span<const size_t> chosen, double deviations)>;
std::vector<Interval> curveIntervals(size_t runs, const CurveStatistics& statistics,
                                     double confidence = 0.95);

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
