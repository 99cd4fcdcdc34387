// What a method gains over the yardstick while frames accumulate: at equal time, to equal error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/summary/accumulated_curve.h"

namespace restlab {

// One ratio, read off the two fitted lines at a place inside both measured ranges; intervals by the
// jackknife over runs paired by seed, of the logarithm.
struct CurveReading {
  Interval ratio;     // NaN: not read, and `why` says why
  Interval measured;  // the same between the measured points, without a line
  double at = 0.0;    // the time in ms, or the MSE
  // The interval of ratio / measured leaves out 1, by more than kMisfitMin: the lines do not
  // describe the curves there.
  bool isOffTheLines = false;
  std::string why;
};

struct SpeedUp {
  CurveReading equalTime;   // mse(path) / mse(method) at the end of the curve that ends first
  CurveReading equalError;  // time(path) / time(method) at the lowest error that both have had
};

// Nothing where one of them holds no accumulation, or no times. The noises
// are of one reference: it moves both curves the same way.
std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method,
                                 const AccumulatedNoise& pathNoise = {},
                                 const AccumulatedNoise& methodNoise = {});

}  // namespace restlab
