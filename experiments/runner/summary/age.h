// Error over the age of the history, relative to the yardstick and to the plain average of the
// yardstick's frames, which costs no additional rays.
#pragma once

#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/reference/reference_noise.h"

namespace restlab {

struct AgeSummary {
  uint32_t age = 0;
  Interval mse;
  Interval timeRatio;       // this frame's time over that of the yardstick's
  Interval mseRatio;        // MSE of the yardstick's frame of this age / MSE
  Interval ratioToAverage;  // MSE of the average of the yardstick's frames / MSE
};

// Runs to compare with, and the reference's noise in their MSE. No runs: unknown.
struct AgeYardstick {
  const std::vector<RunResult>* runs = nullptr;
  ReferenceNoise noise;
};

// Compares runs in pairs: runs of one number were interleaved. `own`: the method's own runs.
std::vector<AgeSummary> agesOf(const AgeYardstick& own, const AgeYardstick& yardstick,
                               const AgeYardstick& average);

}  // namespace restlab
