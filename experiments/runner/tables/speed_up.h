// Gain of a method over the baseline while frames accumulate: at equal time, to equal error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/tables/accumulated_curve.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

// One ratio, read off the two fitted lines at a place inside both measured ranges. Intervals are
// the jackknife of its logarithm over runs paired by seed.
struct CurveReading {
  Interval ratio;     // NaN: not read, see `why`
  Interval measured;  // the same interpolated between measured points, without a line
  double at = 0.0;    // time in ms, or MSE
  // Set if the interval of ratio / measured leaves out 1, by more than kMisfitMin: the lines do not
  // describe the curves there.
  bool isOffTheLines = false;
  std::string why;
};

struct SpeedUp {
  CurveReading equalTime;   // mse(path) / mse(method) at the end of the curve that ends first
  CurveReading equalError;  // time(path) / time(method) at the lowest error that both have had
};

// Returns nothing if one of them has no accumulated images or no times. Both noises must be of one
// reference: its noise moves both curves the same way.
std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method,
                                 const AccumulatedNoise& pathNoise = {},
                                 const AccumulatedNoise& methodNoise = {});

}  // namespace restlab
