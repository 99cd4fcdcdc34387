#include "experiments/runner/tables/convergence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/nan.h"
#include "experiments/runner/tables/accumulated_curve.h"

namespace restlab {

namespace {

// Returns log10(mse / line) of every point; NaN for points that are not fitted.
std::vector<double> residuals(const AccumulatedCurve& curve, size_t points) {
  std::vector<double> all(points, kNan);
  const CurveLine line = fitLine(curve);
  for (const CurvePoint& point : curve)
    all[point.index] = (point.logMse - line.at(point.logTime)) / std::numbers::ln10;
  return all;
}

// Tests each measured point against the line. The error probability is divided among the points.
void judgeLine(const std::vector<RunResult>& runs, const AccumulatedNoise& noise,
               Convergence& curve) {
  const double each = (1.0 - kMisfitConfidence) / double(std::max<size_t>(1, curve.fitted()));
  const auto statistics = [&](std::span<const size_t> chosen, double deviations) {
    return residuals(accumulatedCurve(runs, chosen, noise, deviations), curve.points.size());
  };
  for (const Interval& off : curveIntervals(runs.size(), statistics, 1.0 - each)) {
    if (std::isnan(off.value)) continue;
    curve.misfit = std::max(curve.misfit, std::abs(off.value));
    if (std::abs(off.value) <= kMisfitMin || !(off.lo > 0.0 || off.hi < 0.0)) continue;
    curve.isNoLine = true;
    curve.significantMisfit = std::max(curve.significantMisfit, std::abs(off.value));
  }
}

}  // namespace

size_t Convergence::fitted() const {
  return size_t(std::count_if(points.begin(), points.end(),
                              [](const ConvergencePoint& point) { return point.isFitted; }));
}

bool isFalling(const Interval& slope) {
  return std::isnan(slope.hi) ? slope.value < 0.0 : slope.hi < 0.0;
}

std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs,
                                         const AccumulatedNoise& noise) {
  if (runs.empty() || runs.front().accumulated.empty()) return std::nullopt;
  Convergence curve;
  for (size_t i = 0; i < runs.front().accumulated.size(); ++i) {
    std::vector<double> mse;
    ConvergencePoint point;
    point.frames = runs.front().accumulated[i].frames;
    point.isFitted = false;
    for (const RunResult& run : runs) {
      mse.push_back(run.accumulated.at(i).error.mse);
      point.timeMs += run.accumulated[i].timeMs / double(runs.size());
    }
    const double variance = varianceOfPoint(runs, everyRun(runs.size()), i, noise);
    point.mse = widened(meanInterval(mse), variance);
    curve.points.push_back(point);
  }
  for (const CurvePoint& point : accumulatedCurve(runs, everyRun(runs.size()), noise))
    curve.points[point.index].isFitted = true;
  const auto ofLine = [&](std::span<const size_t> chosen, double deviations) {
    const CurveLine line = fitLine(accumulatedCurve(runs, chosen, noise, deviations));
    return std::vector<double>{line.slope, line.intercept};
  };
  const std::vector<Interval> line = curveIntervals(runs.size(), ofLine);
  curve.slope = line[0];
  curve.intercept = line[1].value;
  judgeLine(runs, noise, curve);
  return curve;
}

}  // namespace restlab
