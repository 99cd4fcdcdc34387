#include "experiments/runner/tables/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/image/metrics/metrics.h"
#include "experiments/report/text.h"
#include "experiments/runner/reference/reference_error.h"
#include "experiments/runner/run/figures.h"
#include "experiments/runner/tables/judge.h"
#include "experiments/statistics/halves_noise.h"

namespace restlab {

namespace {

std::vector<double> perRun(const MethodResult& result, double (*value)(const RunResult&)) {
  std::vector<double> values;
  for (const RunResult& run : result.runs) values.push_back(value(run));
  return values;
}

double runMse(const RunResult& run) { return run.measured.mse; }
double runRelmseTrimmed(const RunResult& run) { return run.measured.relmseTrimmed; }
double runMseWithoutLights(const RunResult& run) { return run.measured.mseWithoutLights; }

// Returns the median over frames of time / time of `other` in the same interleaved round.
double runTimeRatio(const RunResult& run, const RunResult& other) {
  if (run.timesMs.empty()) return kUnknown;
  std::vector<double> ratios;
  for (size_t i = 0; i < run.timesMs.size(); ++i)
    ratios.push_back(run.timesMs[i] / other.timesMs.at(i));
  return median(ratios);
}

void summariseSceneWork(const MethodResult& result, MethodSummary& row) {
  row.residuals = result.runs.front().residuals;
  if (std::isnan(row.timeMsMedian)) return;
  row.scenePasses = result.runs.front().scenePasses;
  row.sceneMs = 0.0;
  for (size_t pass = 0; pass < row.scenePasses.size(); ++pass) {
    std::vector<double> times;
    for (const RunResult& run : result.runs) times.push_back(run.scenePasses.at(pass).timeMs);
    row.scenePasses[pass].timeMs = median(times);
    row.sceneMs += row.scenePasses[pass].timeMs;
  }
}

void summariseTimes(const MethodResult& result, size_t pixels, MethodSummary& row) {
  std::vector<double> times;
  for (const RunResult& run : result.runs) {
    times.insert(times.end(), run.timesMs.begin(), run.timesMs.end());
    for (size_t i = 0; i < run.health.health.counts.size(); ++i) {
      row.health.health.counts[i] += run.health.health.counts[i];
    }
    row.health.raysPath += run.health.raysPath;
    row.health.raysShadow += run.health.raysShadow;
  }
  if (!times.empty()) {
    row.timeMsMedian = median(times);
    row.timeMsP95 = percentile(times, 0.95);
  }
  if (row.method->images) return;
  row.timedFrames = size_t(row.suite->timedFrames) * result.runs.size();
  const double samples = double(row.timedFrames) * double(pixels);
  row.raysPathPerPixel = double(row.health.raysPath) / samples;
  row.raysShadowPerPixel = double(row.health.raysShadow) / samples;
  summariseSceneWork(result, row);
  row.passes = result.runs.front().passes;
  for (size_t pass = 0; pass < row.passes.size(); ++pass) {
    std::vector<double> medians;
    for (const RunResult& run : result.runs) medians.push_back(run.passes.at(pass).timeMs);
    row.passes[pass].timeMs = median(medians);
  }
  // Scale the medians of passes to add up to the median frame, so that bars end there.
  double sum = 0.0;
  for (const PassTiming& pass : row.passes) sum += pass.timeMs;
  if (sum > 0.0 && row.timeMsMedian > 0.0) {
    for (PassTiming& pass : row.passes) pass.timeMs *= row.timeMsMedian / sum;
  }
}

// Returns the noise over pixels without lights, as recorded by the runs.
ReferenceNoise noiseInside(const std::vector<RunResult>& runs, bool isUnbiased) {
  HalvesNoise halves;
  halves.varianceOfProduct = runs.front().measured.insideVarianceCommon;
  ReferenceNoise noise;
  noise.common = halves.varianceOfProduct;
  noise.commonAtLeast = halves.varianceOfProductAtLeast();
  double atMost = 0.0;
  for (const RunResult& run : runs)
    atMost += run.measured.insideVarianceAtMost / double(runs.size());
  noise.shared = isUnbiased ? noise.common : std::max(atMost, noise.common);
  return noise;
}

void summariseErrors(const MethodResult& result, const Reference& reference, MethodSummary& row) {
  row.noise = noiseOf(reference, result.measured);
  row.noiseWithoutLights = noiseInside(result.runs, row.bias == BiasClass::unbiased);
  row.mse = widened(meanInterval(perRun(result, runMse)), row.noise.shared);
  row.mseWithoutLights =
      widened(meanInterval(perRun(result, runMseWithoutLights)), row.noiseWithoutLights.shared);
  row.relmse =
      meanInterval(perRun(result, [](const RunResult& run) { return run.measured.relmse; }));
  row.relmseTrimmed = meanInterval(perRun(result, runRelmseTrimmed));
  row.energyRatio =
      meanInterval(perRun(result, [](const RunResult& run) { return run.measured.energyRatio; }));
  row.worstShare = meanInterval(perRun(result, [](const RunResult& run) {
                     return run.measured.worstShare;
                   })).value;
  row.nonfinite = row.health.health.counts[rl::RL_HEALTH_NONFINITE];
  for (const RunResult& run : result.runs) {
    row.nonfinite +=
        run.measured.nonfinite + run.warmupHealth.health.counts[rl::RL_HEALTH_NONFINITE];
  }
  if (reference.half0 && reference.half1) {
    row.biasSquared = result.measured.squaredBias(*reference.half0, *reference.half1);
    if (row.mse.value > 0.0 && !isExactEnough(row)) {
      row.biasShare = {row.biasSquared.value / row.mse.value, row.biasSquared.lo / row.mse.value,
                       row.biasSquared.hi / row.mse.value};
    }
  }
  row.variance = result.measured.variance();
}

// Compares unpaired: images of another program are independent of all runs, and were not
// interleaved.
void compareImages(const MethodResult& path, const MethodSummary& pathRow,
                   const MethodResult& result, MethodSummary& row) {
  const auto ratioOf = [&](double (*value)(const RunResult&), const SharedNoise& shared) {
    return ratioOfPositives(ratioInterval(perRun(path, value), perRun(result, value), shared));
  };
  row.mseRatio = ratioOf(runMse, sharedNoise(pathRow.noise, row.noise));
  row.mseRatioWithoutLights =
      ratioOf(runMseWithoutLights, sharedNoise(pathRow.noiseWithoutLights, row.noiseWithoutLights));
  row.relmseTrimmedRatio = ratioOf(runRelmseTrimmed, {});
  if (std::isnan(row.timeMsMedian) || std::isnan(pathRow.timeMsMedian)) return;
  row.timeRatio.value = row.timeRatioOfMedians = row.timeMsMedian / pathRow.timeMsMedian;
  row.efficiencyRatio.value = row.mseRatio.value / row.timeRatio.value;
}

// `value`: over all runs, including those without a partner.
Interval pairedErrorRatio(const std::vector<double>& numerators,
                          const std::vector<double>& denominators, double value,
                          const SharedNoise& shared = {}) {
  const Interval paired = ratioOfPositives(pairedRatioInterval(numerators, denominators, shared));
  // Equal numbers have the exact ratio 1, whatever their spread.
  if (numerators == denominators && paired.value == 1.0) return paired;
  return {value, paired.lo, paired.hi};
}

void compareWithBaseline(const MethodResult& path, const MethodSummary& pathRow,
                         const MethodResult& result, MethodSummary& row) {
  if (row.method->images) return compareImages(path, pathRow, result, row);
  // An interrupted block may have one more run of the first methods.
  const size_t paired = std::min(path.runs.size(), result.runs.size());
  std::vector<double> pathMse, mse, timeRatios, work, pathInside, inside, pathTrimmed, trimmed;
  for (size_t r = 0; r < paired; ++r) {
    pathMse.push_back(runMse(path.runs[r]));
    mse.push_back(runMse(result.runs[r]));
    timeRatios.push_back(runTimeRatio(result.runs[r], path.runs[r]));
    work.push_back(mse.back() * timeRatios.back());
    pathInside.push_back(runMseWithoutLights(path.runs[r]));
    inside.push_back(runMseWithoutLights(result.runs[r]));
    pathTrimmed.push_back(runRelmseTrimmed(path.runs[r]));
    trimmed.push_back(runRelmseTrimmed(result.runs[r]));
  }
  // Equal errors occur, e.g. for general kernels and kernels of the scene.
  const bool isSame = pathMse == mse;
  const SharedNoise shared = sharedNoise(pathRow.noise, row.noise, isSame);
  row.mseRatio = pairedErrorRatio(pathMse, mse, pathRow.mse.value / row.mse.value, shared);
  row.mseRatioWithoutLights = pairedErrorRatio(
      pathInside, inside, pathRow.mseWithoutLights.value / row.mseWithoutLights.value,
      sharedNoise(pathRow.noiseWithoutLights, row.noiseWithoutLights, isSame));
  row.relmseTrimmedRatio =
      pairedErrorRatio(pathTrimmed, trimmed, pathRow.relmseTrimmed.value / row.relmseTrimmed.value);
  row.timeRatio = geometricMeanInterval(timeRatios);
  row.timeRatioOfMedians = row.timeMsMedian / pathRow.timeMsMedian;
  const double time = row.timeRatio.value;
  if (isSame) {  // only the times differ
    row.efficiencyRatio = {1.0 / time, 1.0 / row.timeRatio.hi, 1.0 / row.timeRatio.lo};
    return;
  }
  row.efficiencyRatio = pairedRatioInterval(
      pathMse, work,
      {shared.numerator, time * time * shared.denominator, time * shared.covariance});
  // Fieller's interval is of the arithmetic mean of the time ratios; `value` uses their geometric
  // mean.
  const double value = row.mseRatio.value / time;
  const double shift = value / row.efficiencyRatio.value;
  row.efficiencyRatio =
      ratioOfPositives({value, shift * row.efficiencyRatio.lo, shift * row.efficiencyRatio.hi});
}

// Returns the time of a method relative to the same method on another backend.
Interval timeAgainst(const MethodResult& result, const MethodResult& first) {
  std::vector<double> ratios;
  for (size_t r = 0; r < std::min(result.runs.size(), first.runs.size()); ++r)
    ratios.push_back(runTimeRatio(result.runs[r], first.runs[r]));
  return geometricMeanInterval(ratios);
}

AccumulatedNoise accumulatedNoise(const MethodSummary& row) {
  return {row.noise.common, row.bias == BiasClass::unbiased};
}

// Returns nothing if a run has no temporal figures.
std::optional<TemporalSummary> temporalOf(const std::vector<RunResult>& runs) {
  for (const RunResult& run : runs) {
    if (!run.temporal) return std::nullopt;
  }
  const auto over = [&](auto value) {
    std::vector<double> values;
    for (const RunResult& run : runs) values.push_back(value(*run.temporal));
    return meanInterval(values);
  };
  TemporalSummary all;
  all.variance = over([](const TemporalFigures& figures) { return figures.variance; });
  all.difference = over([](const TemporalFigures& figures) { return figures.difference; });
  all.errorDifferenceSquared =
      over([](const TemporalFigures& figures) { return figures.errorDifferenceSquared; });
  all.referenceDifference = runs.front().temporal->referenceDifference;
  all.referenceDifferenceNoise = runs.front().temporal->referenceDifferenceNoise;
  for (size_t lag = 0; lag < all.autocorrelation.size(); ++lag) {
    all.autocorrelation[lag] =
        over([lag](const TemporalFigures& figures) { return figures.autocorrelation[lag]; });
  }
  return all;
}

// Flags noise of the references, which is the same in every row.
void noteTemporal(MethodSummary& row) {
  if (!row.temporal) return;
  const double share = row.temporal->referenceDifferenceNoise / row.temporal->referenceDifference;
  if (!(share > kReferenceDifferenceNoiseMax)) return;
  row.flags.push_back(
      fmt::format("of the difference of the references, up to {:.0f} % is their noise: more spp",
                  100.0 * share));
}

// Uses one value per run; unknown if a run lacks it.
std::vector<std::pair<std::string, Interval>> figuresOf(const Suite& suite,
                                                        const MethodResult& result,
                                                        const ReferenceNoise& noise) {
  std::vector<std::pair<std::string, Interval>> figures;
  for (const FigureInfo& figure : figureInfos(suite)) {
    std::vector<double> values;
    for (const RunResult& run : result.runs) {
      for (const auto& [name, measured] : run.figures) {
        if (name == figure.name) values.push_back(measured.value);
      }
    }
    const bool isKnown = values.size() == result.runs.size();
    Interval over = isKnown ? meanInterval(values) : Interval{kUnknown, kUnknown, kUnknown};
    // The shared noise over a mask is unknown, because images of runs are not kept.
    if (figure.metric == "mse" && figure.mask < 0) over = widened(over, noise.shared);
    figures.emplace_back(figure.name, over);
  }
  return figures;
}

void noteConvergence(MethodSummary& row) {
  if (!row.convergence || !row.convergence->isNoLine) return;
  row.flags.push_back(
      fmt::format("its accumulated errors do not lie on a line: up to {}x off it, more than the "
                  "spread of the runs",
                  shortNumber(std::pow(10.0, row.convergence->significantMisfit))));
}

void noteReading(const CurveReading& reading, const char* what, const char* gain, const char* loss,
                 MethodSummary& row) {
  if (!reading.why.empty()) row.flags.push_back(fmt::format("nothing {}: {}", what, reading.why));
  if (!reading.isOffTheLines) return;
  const Interval& measured = reading.measured;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  row.flags.push_back(fmt::format("{} {} between the measured points, not {} as off the lines",
                                  what,
                                  timesText(measured.value, measured.lo, measured.hi, gain, loss),
                                  timesText(reading.ratio.value, nan, nan, gain, loss)));
}

void noteSpeedUp(MethodSummary& row) {
  if (!row.speedUp || row.isBaseline) return;
  noteReading(row.speedUp->equalTime, "at equal time", "lower", "higher", row);
  noteReading(row.speedUp->equalError, "to equal error", "faster", "slower", row);
}

// Compares with the average of the baseline's frames, and with both over the age of the history.
void compareAges(const Suite& suite, const BlockResult& block, size_t m,
                 const std::vector<size_t>& rowOf, std::vector<MethodSummary>& rows) {
  MethodSummary& row = rows[rowOf[m]];
  const auto runsOf = [&](size_t method) {
    const size_t at = rowOf[method];
    return at < rows.size() ? AgeBaseline{&block.methods[method].runs, rows[at].noise}
                            : AgeBaseline{};
  };
  const AgeBaseline own = runsOf(m), average = runsOf(suite.average(m));
  row.isAverage = m == suite.average(m);
  if (average.runs && !row.isAverage && !row.method->images) {
    const size_t paired = std::min(own.runs->size(), average.runs->size());
    std::vector<double> mse, others;
    for (size_t r = 0; r < paired; ++r) {
      mse.push_back(runMse((*own.runs)[r]));
      others.push_back(runMse((*average.runs)[r]));
    }
    row.ratioToAverage =
        ratioOfPositives(pairedRatioInterval(others, mse, sharedNoise(average.noise, own.noise)));
  }
  if (!own.runs->front().aged.empty()) row.ages = agesOf(own, runsOf(suite.baselineOf(m)), average);
}

// Leaves ratios of times alone, which are of runs on one machine each.
void noteMachines(const BlockResult& block, MethodSummary& row) {
  if (block.unlikeMachines.empty() || row.method->images) return;
  row.flags.push_back(fmt::format(
      "its runs were made on unlike machines ({}): only ratios of times within a run are given",
      fmt::join(block.unlikeMachines, "; ")));
  row.timeMsMedian = row.timeMsP95 = row.timeRatioOfMedians = row.sceneMs = kUnknown;
  row.passes.clear();
  row.scenePasses.clear();
}

}  // namespace

std::vector<MethodSummary> summarise(const Suite& suite, const BlockResult& block) {
  std::vector<MethodSummary> rows;
  const size_t pixels = size_t(block.width) * block.height;
  std::vector<size_t> rowOf(suite.methods.size() + 1, suite.methods.size());
  for (size_t m = 0; m < block.methods.size(); ++m) {
    const MethodResult& result = block.methods[m];
    if (result.runs.empty()) continue;
    MethodSummary row;
    row.suite = &suite;
    row.method = &suite.methods[m];
    row.block = &block;
    row.result = &result;
    row.bias = row.method->bias(suite);
    row.runs = uint32_t(result.runs.size());
    summariseTimes(result, pixels, row);
    summariseErrors(result, block.reference, row);
    row.convergence = convergenceOf(result.runs, accumulatedNoise(row));
    noteConvergence(row);
    row.temporal = temporalOf(result.runs);
    noteTemporal(row);
    row.figures = figuresOf(suite, result, row.noise);
    if (row.method->images && row.runs != suite.runs) {
      row.flags.push_back(row.runs == 1 ? "one image" : fmt::format("{} images", row.runs));
    }
    judge(row);
    row.isBaseline = m == suite.baselineOf(m);
    rowOf[m] = rows.size();
    rows.push_back(std::move(row));
  }
  for (size_t m = 0; m < block.methods.size(); ++m) {
    if (rowOf[m] >= rows.size()) continue;
    MethodSummary& row = rows[rowOf[m]];
    if (const size_t path = rowOf[suite.baselineOf(m)]; path < rows.size()) {
      const MethodSummary baseline = rows[path];
      compareWithBaseline(*baseline.result, baseline, *row.result, row);
      row.speedUp = speedUpOf(baseline.result->runs, row.result->runs, accumulatedNoise(baseline),
                              accumulatedNoise(row));
      noteSpeedUp(row);
    }
    compareAges(suite, block, m, rowOf, rows);
    const size_t first = suite.onFirstBackend(m);
    if (first != m && rowOf[first] < rows.size())
      row.timeToFirstBackend = timeAgainst(*row.result, block.methods[first]);
  }
  for (MethodSummary& row : rows) noteMachines(block, row);
  return rows;
}

}  // namespace restlab
