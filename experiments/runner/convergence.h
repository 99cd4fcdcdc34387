// Error against run time while frames accumulate: curves, fitted lines, speed-ups.
#pragma once

#include <optional>
#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/experiment.h"

namespace restlab {

struct ConvergencePoint {
  uint32_t frames = 0;
  double timeMs = 0.0;   // mean over runs of the time since the history began
  Interval mse;          // mean over runs
  double noise = 0.0;    // standard deviation of what the reference adds to all of them
  bool isFitted = true;  // false: its interval holds 0, the error is below the reference's noise
};

// log(mse) = intercept + slope log(timeMs), least squares over the fitted points, each of them the
// mean over runs. Points share their samples, so the slope's interval is the jackknife's over runs.
// All points share the reference: intervals are wider by what moves a line when its noise moves
// them all by one standard deviation.
struct Convergence {
  std::vector<ConvergencePoint> points;
  Interval slope;  // -1 for independent frames without start-up; NaN with fewer than two points
  double intercept = 0.0;
};

// What the reference's noise adds to all runs of a method, in points of an accumulation.
struct AccumulatedNoise {
  double common = 0.0;  // variance in the MSE of every unbiased method
  // Images of accumulations are not kept, so that of another one only an upper bound is known, that
  // of its runs (FrameError::mseVarianceAtMost).
  bool isUnbiased = true;
};

// Against the yardstick, off the two fitted lines; intervals by the jackknife over runs paired by
// seed, of the logarithm.
struct SpeedUp {
  Interval equalTime;   // mse(path) / mse(method) at `timeMs`
  double timeMs = 0.0;  // the end of the shorter of the two curves
  Interval equalError;  // time(path) / time(method) at `mse`
  double mse = 0.0;     // the error at the end of the worse of the two lines
};

// Nothing where the runs hold no accumulation.
std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs,
                                         const AccumulatedNoise& noise = {});
// Nothing where one of them has no line.
std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method,
                                 const AccumulatedNoise& pathNoise = {},
                                 const AccumulatedNoise& methodNoise = {});

}  // namespace restlab
