// Runs of accumulated frames with known errors plus noise.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "experiments/runner/tables/accumulated_curve.h"

namespace restlab {

struct SyntheticCurve {
  double scale = 1.0, frameMs = 1.0;
  double slope = -1.0;
  double noise = 0.0;  // relative, per run
  double floor = 0.0;  // MSE that accumulation does not lower, relative to `scale`
  int points = 7;      // 1, 2, 4, ... frames
  int runs = 8;
};

// Makes a run whose MSE after n frames is scale (n^slope + floor) times (1 + noise). The noise is
// correlated from point to point, like means of the same frames.
inline RunResult runOf(std::mt19937& random, const SyntheticCurve& curve) {
  std::normal_distribution<double> normal;
  RunResult run;
  double sum = 0.0, frames = 0.0;
  for (int k = 0; k < curve.points; ++k) {
    const double count = std::exp2(k);
    while (frames < count) {
      sum += 1.0 + curve.noise * normal(random);
      frames += 1.0;
    }
    AccumulatedError point;
    point.frames = uint32_t(count);
    point.timeMs = curve.frameMs * count;
    point.error.mse = curve.scale * (std::pow(count, curve.slope) + curve.floor) *
                      (sum / frames + curve.noise * normal(random));
    run.accumulated.push_back(point);
  }
  return run;
}

// Returns the noise of a reference that hides errors up to `mse`.
inline AccumulatedNoise noiseBelow(double mse) {
  const double deviation = mse / kNoiseOfFittedErrors;
  return {deviation * deviation, true};
}

inline std::vector<RunResult> runsOf(uint32_t seed, const SyntheticCurve& curve) {
  std::mt19937 random(seed);
  std::vector<RunResult> all;
  for (int i = 0; i < curve.runs; ++i) all.push_back(runOf(random, curve));
  return all;
}

}  // namespace restlab
