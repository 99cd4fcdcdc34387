// Error against run time while frames accumulate: curves, and the lines fitted to them.
#pragma once

#include <optional>
#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/summary/accumulated_curve.h"

namespace restlab {

struct ConvergencePoint {
  uint32_t frames = 0;
  double timeMs = 0.0;   // mean over runs of the time since the history began
  Interval mse;          // mean over runs
  bool isFitted = true;  // false: not above the noise of the reference
};

// log(mse) = intercept + slope log(timeMs), least squares over the fitted points, each of them the
// mean over runs. Points share their samples, so the slope's interval is the jackknife's over runs.
// All points share the reference: intervals are wider by what moves a line when its noise moves
// them all by one standard deviation.
struct Convergence {
  std::vector<ConvergencePoint> points;
  Interval slope;  // -1 for independent frames without start-up; NaN with fewer than two points
  double intercept = 0.0;
  // The largest |log10(mse / line)| of the fitted points. `isNoLine`: some of them stand further
  // from it than the spread of the runs explains, and than kMisfitMin.
  double misfit = 0.0;
  double significantMisfit = 0.0;  // the largest of those points
  bool isNoLine = false;

  size_t fitted() const;
};

// Of all 95 sets in 100 whose curve is a line none of the points counts as off it; and what is less
// than 5 % off counts for none.
constexpr double kMisfitConfidence = 0.95;
constexpr double kMisfitMin = 0.0212;  // log10(1.05)

// Nothing where the runs hold no accumulation.
std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs,
                                         const AccumulatedNoise& noise = {});

// False where the interval of a slope does not say that the error falls; with too few runs for an
// interval the slope itself decides.
bool isFalling(const Interval& slope);

}  // namespace restlab
