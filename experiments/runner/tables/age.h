// Error over the age of the history, relative to the baseline and to the plain average of the
// baseline's frames, which costs no additional rays.
#pragma once

#include <vector>

#include "experiments/runner/reference/reference_noise.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

struct AgeSummary {
  uint32_t age = 0;
  Interval mse;
  Interval timeRatio;       // this frame's time over that of the baseline's
  Interval mseRatio;        // MSE of the baseline's frame of this age / MSE
  Interval ratioToAverage;  // MSE of the average of the baseline's frames / MSE
};

// Runs to compare with, and the reference's noise in their MSE. No runs: unknown.
struct AgeBaseline {
  const std::vector<RunResult>* runs = nullptr;
  ReferenceNoise noise;
};

// Compares runs in pairs: runs of one number were interleaved. `own`: the method's own runs.
std::vector<AgeSummary> agesOf(const AgeBaseline& own, const AgeBaseline& baseline,
                               const AgeBaseline& average);

}  // namespace restlab
