// Summarises the runs of a block in one row per method: means, 95 % intervals, ratios to `path`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/reference_noise.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/tables/age.h"
#include "experiments/runner/tables/convergence.h"
#include "experiments/runner/tables/speed_up.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A biased row does not count if the whole interval lies outside these bounds.
constexpr double kEnergyRatioMin = 0.95, kEnergyRatioMax = 1.05;
constexpr double kBiasShareMax = 0.25;
// A row declared unbiased is doubted if its energy or its squared bias differs from the expected
// value by more than this many half widths of the interval. The energy test doubted none of 800
// sets of 8 runs of correct estimators in four built-in scenes (docs/manual.md).
constexpr double kDoubtHalfWidths = 3.0;
// If the worst 0.1 % of the pixels cause more than this share of the MSE, its interval says little.
constexpr double kWorstShareMax = 0.5;
// Flags noise of the references that may exceed this share of their difference.
constexpr double kReferenceDifferenceNoiseMax = 0.05;

// TemporalFigures, averaged over runs.
struct TemporalSummary {
  Interval variance, difference, errorDifferenceSquared;
  double referenceDifference = kUnknown, referenceDifferenceNoise = kUnknown;  // same for all runs
  std::array<Interval, std::tuple_size_v<decltype(TemporalFigures::autocorrelation)>>
      autocorrelation;
};

struct MethodSummary {
  const Suite* suite = nullptr;
  const SuiteMethod* method = nullptr;
  const BlockResult* block = nullptr;
  const MethodResult* result = nullptr;
  BiasClass bias = BiasClass::unbiased;
  uint32_t runs = 0;

  double timeMsMedian = kUnknown, timeMsP95 = kUnknown;  // over all timed frames of all runs
  // Over runs. Intervals of mse, mseWithoutLights, biasSquared and their ratios include the noise
  // of the reference's halves, which all runs share.
  Interval mse, mseWithoutLights, relmse, relmseTrimmed, energyRatio;
  ReferenceNoise noise, noiseWithoutLights;
  // May be negative; over all pairs of runs; unknown with one run or without halves.
  Interval biasSquared{kUnknown, kUnknown, kUnknown};
  // biasSquared / mse.value; unknown where the MSE is 0 or within the error of an exact image.
  Interval biasShare{kUnknown, kUnknown, kUnknown};
  Interval variance{kUnknown, kUnknown, kUnknown};  // the rest of the MSE
  double worstShare = kUnknown;                     // mean over runs
  uint64_t nonfinite = 0;                           // in images, and samples set to zero

  // Relative to the baseline on the same backend: path / method for errors, method / path for
  // times.
  Interval mseRatio{kUnknown, kUnknown, kUnknown};
  Interval mseRatioWithoutLights{kUnknown, kUnknown, kUnknown};
  Interval relmseTrimmedRatio{kUnknown, kUnknown, kUnknown};
  // Geometric mean over runs of the run's median over frames of time(method) / time(path) of that
  // frame. A temporary slowdown of the machine affects both and cancels.
  Interval timeRatio{kUnknown, kUnknown, kUnknown};
  double timeRatioOfMedians = kUnknown;
  // Same ratio to this method on the suite's first backend; unknown on the first backend itself.
  Interval timeToFirstBackend{kUnknown, kUnknown, kUnknown};
  bool isBaseline = false;
  Interval efficiencyRatio{kUnknown, kUnknown, kUnknown};  // mseRatio / timeRatio

  // MSE of the plain average of the baseline's frames / MSE; unknown if the suite has no average.
  Interval ratioToAverage{kUnknown, kUnknown, kUnknown};
  bool isAverage = false;        // this row is that average
  std::vector<AgeSummary> ages;  // at the suite's ages

  std::optional<Convergence> convergence;   // if the suite accumulates
  std::optional<SpeedUp> speedUp;           // relative to the baseline
  std::optional<TemporalSummary> temporal;  // if the suite asks for it

  // Further figures of the suite, in the order of figureInfos(); unknown if the mask is of another
  // scene.
  std::vector<std::pair<std::string, Interval>> figures;

  double raysPathPerPixel = kUnknown, raysShadowPerPixel = kUnknown;
  std::vector<PassTiming> passes;       // scaled to add up to timeMsMedian
  std::vector<PassTiming> scenePasses;  // work for the scene: medians over runs
  double sceneMs = kUnknown;            // their sum
  std::vector<double> residuals;        // of the first run, by iteration
  HealthSum health;                     // over all timed frames
  uint64_t timedFrames = 0;

  std::vector<std::string> flags;   // why the row does not count, and what its numbers lack
  std::vector<std::string> doubts;  // those of them for which its numbers are not to be trusted
  bool counts = true;               // false: bounds violated, or values that are not finite

  void doubt(std::string flag) {
    doubts.push_back(flag);
    flags.push_back(std::move(flag));
  }
};

// Returns one summary per method with at least one finished run.
std::vector<MethodSummary> summarise(const Suite& suite, const BlockResult& block);

inline Interval percent(const Interval& of) {
  return {100.0 * of.value, 100.0 * of.lo, 100.0 * of.hi};
}

// Returns an error as tables show it: a positive error with a lower end below 0 is unbounded below.
// An error below the noise of its reference is unchanged.
inline Interval errorOf(const Interval& mse) {
  return mse.value > 0.0 ? ratioOfPositives(mse) : mse;
}

}  // namespace restlab
