// Error over run time while frames accumulate: curves, and the lines fitted to them.
#pragma once

#include <optional>
#include <vector>

#include "experiments/runner/tables/accumulated_curve.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

struct ConvergencePoint {
  uint32_t frames = 0;
  double timeMs = 0.0;   // mean over runs of the time since the history began
  Interval mse;          // mean over runs
  bool isFitted = true;  // false: below the noise of the reference
};

// log(mse) = intercept + slope log(timeMs), least squares over the fitted points, each the mean
// over runs. Points share their samples, so the slope's interval is the jackknife over runs. All
// points share the reference: intervals are widened by the change of the line when the reference's
// noise moves all points by one standard deviation.
struct Convergence {
  std::vector<ConvergencePoint> points;
  Interval slope;  // -1 for independent frames without start-up; NaN with fewer than two points
  double intercept = 0.0;
  // Largest |log10(mse / line)| of the fitted points. `isNoLine`: some points are further off than
  // kMisfitMin and than the spread of the runs explains.
  double misfit = 0.0;
  double significantMisfit = 0.0;  // largest misfit of those points
  bool isNoLine = false;

  size_t fitted() const;
};

// If the true curve is a line, no point counts as off it in 95 of 100 sets of runs. A point less
// than 5 % off never counts.
constexpr double kMisfitConfidence = 0.95;
constexpr double kMisfitMin = 0.0212;  // log10(1.05)

// Returns nothing if the runs have no accumulated images.
std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs,
                                         const AccumulatedNoise& noise = {});

// Returns whether the interval of a slope lies below 0; with too few runs for an interval, whether
// the slope does.
bool isFalling(const Interval& slope);

}  // namespace restlab
