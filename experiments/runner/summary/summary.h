// From the runs of a block to one row a method: means, 95 % intervals, ratios against `path`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/image/intervals.h"
#include "experiments/runner/summary/age.h"
#include "experiments/runner/summary/convergence.h"
#include "experiments/runner/run/experiment.h"
#include "experiments/runner/reference/reference_noise.h"
#include "experiments/runner/summary/speed_up.h"

namespace restlab {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A biased row does not count where a whole interval lies outside these bounds.
constexpr double kEnergyRatioMin = 0.95, kEnergyRatioMax = 1.05;
constexpr double kBiasShareMax = 0.25;
// A row that is declared unbiased is doubted where its energy or its squared bias is further from
// what it should be than so many times the half width of the interval. Of 800 sets of 8 runs of
// correct estimators, in four built-in scenes, none was by its energy (docs/manual.md).
constexpr double kDoubtHalfWidths = 3.0;
// Above this share of the MSE in the worst 0.1 % of the pixels its interval says little.
constexpr double kWorstShareMax = 0.5;
// The noise of the references is said where it may be more than this share of their difference.
constexpr double kReferenceDifferenceNoiseMax = 0.05;

// Of TemporalFigures, over runs.
struct TemporalSummary {
  Interval variance, difference, errorDifferenceSquared;
  double referenceDifference = kUnknown, referenceDifferenceNoise = kUnknown;  // of no run
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
  // Over runs. The noise of the reference's halves, which all runs share, is in the intervals of
  // mse, mseWithoutLights, biasSquared and of their ratios.
  Interval mse, mseWithoutLights, relmse, relmseTrimmed, energyRatio;
  ReferenceNoise noise, noiseWithoutLights;
  // Signed; over all pairs of runs; unknown with one run or no halves.
  Interval biasSquared{kUnknown, kUnknown, kUnknown};
  Interval biasShare{kUnknown, kUnknown, kUnknown};  // biasSquared / mse.value, where that is > 0
  Interval variance{kUnknown, kUnknown, kUnknown};   // the rest of the MSE
  double worstShare = kUnknown;                      // mean over runs
  uint64_t nonfinite = 0;                            // in images, and sample values set to zero

  // Against the yardstick on the same backend: path / method for the error, method / path for the
  // time.
  Interval mseRatio{kUnknown, kUnknown, kUnknown};
  Interval mseRatioWithoutLights{kUnknown, kUnknown, kUnknown};
  Interval relmseTrimmedRatio{kUnknown, kUnknown, kUnknown};
  // Geometric mean over runs of the run's median over frames of time(method) / time(path) of that
  // frame: what slows the machine down for a while slows both and cancels.
  Interval timeRatio{kUnknown, kUnknown, kUnknown};
  double timeRatioOfMedians = kUnknown;
  // The same against this method on the suite's first backend; unknown on that one itself.
  Interval timeToFirstBackend{kUnknown, kUnknown, kUnknown};
  bool isYardstick = false;
  Interval efficiencyRatio{kUnknown, kUnknown, kUnknown};  // mseRatio / timeRatio

  // MSE of the plain average of the yardstick's frames / MSE; unknown where the suite has none.
  Interval ratioToAverage{kUnknown, kUnknown, kUnknown};
  bool isAverage = false;        // this row is that average
  std::vector<AgeSummary> ages;  // the suite's

  std::optional<Convergence> convergence;   // where the suite accumulates
  std::optional<SpeedUp> speedUp;           // against the yardstick
  std::optional<TemporalSummary> temporal;  // where the suite asks for it

  // The suite's further figures, in the order of figureInfos(); unknown where the mask is of
  // another scene.
  std::vector<std::pair<std::string, Interval>> figures;

  double raysPathPerPixel = kUnknown, raysShadowPerPixel = kUnknown;
  std::vector<PassTiming> passes;  // shares of timeMsMedian, by the medians over runs
  HealthSum health;                // of all timed frames
  uint64_t timedFrames = 0;

  std::vector<std::string> flags;  // why the row does not count, or what its reader must know
  bool counts = true;              // false: shown to be out of bounds, or non-finite values
};

// One summary a method that has at least one finished run.
std::vector<MethodSummary> summarise(const Suite& suite, const BlockResult& block);

inline Interval percent(const Interval& of) {
  return {100.0 * of.value, 100.0 * of.lo, 100.0 * of.hi};
}

// An error as tables show it: above 0, a lower end that is not says that there is no bound. One
// below the noise of its reference stays as it is.
inline Interval errorOf(const Interval& mse) {
  return mse.value > 0.0 ? ratioOfPositives(mse) : mse;
}

const char* biasName(BiasClass bias);

}  // namespace restlab
