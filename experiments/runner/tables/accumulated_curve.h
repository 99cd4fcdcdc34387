// Mean error of accumulated frames over time, in natural logarithms: the fitted line, and
// interpolation between the measured points.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "experiments/runner/run/experiment.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

// Noise that the reference adds to all runs of a method, at points of an accumulation.
struct AccumulatedNoise {
  double common = 0.0;  // variance in the MSE of every unbiased method
  // Accumulated images are not kept. For a biased method only an upper bound of the variance is
  // known, from its runs (FrameError::mseVarianceAtMost).
  bool isUnbiased = true;
};

// Returns that variance at one point, for these runs; NaN if lines of older programs lack it.
double varianceOfPoint(const std::vector<RunResult>& runs, std::span<const size_t> chosen,
                       size_t point, const AccumulatedNoise& noise);

// Excludes errors below this many standard deviations of the reference's noise from fits.
constexpr double kNoiseOfFittedErrors = 4.0;

struct CurvePoint {
  size_t index = 0;  // among the accumulated images of a run
  double logTime = 0.0, logMse = 0.0;
};

// Sorted by time.
using AccumulatedCurve = std::vector<CurvePoint>;

// Returns the curve of the mean over these runs, moved by `deviations` standard deviations of the
// reference's noise. Leaves out points without a logarithm, and points whose error before the move
// is below kNoiseOfFittedErrors standard deviations.
AccumulatedCurve accumulatedCurve(const std::vector<RunResult>& runs,
                                  std::span<const size_t> chosen, const AccumulatedNoise& noise,
                                  double deviations = 0.0);

// Returns the indices of all runs: 0, 1, 2, ...
std::vector<size_t> everyRun(size_t runs);

// Returns intervals of statistics of curves: the jackknife over runs, widened() by the change that
// one standard deviation of the reference's noise, up or down, causes.
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

// Fits by least squares; NaN with fewer than two times.
CurveLine fitLine(const AccumulatedCurve& curve);

// Interpolates linearly between the measured points and extrapolates beyond them; NaN with fewer
// than two points.
double interpolatedError(const AccumulatedCurve& curve, double logTime);
// Returns the first time at which the interpolated error falls to `logMse`; NaN if there is none.
double interpolatedTime(const AccumulatedCurve& curve, double logMse);

}  // namespace restlab
