#include "experiments/runner/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace restlab {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Line {
  double slope = kNan, intercept = kNan;
  double at(double logTime) const { return intercept + slope * logTime; }
  double reaches(double logMse) const { return (logMse - intercept) / slope; }
};

std::vector<size_t> fittedPoints(const Convergence& curve) {
  std::vector<size_t> points;
  for (size_t i = 0; i < curve.points.size(); ++i) {
    if (curve.points[i].isFitted) points.push_back(i);
  }
  return points;
}

// Least squares over the given points of the means over these runs, moved by so many standard
// deviations of the reference's noise.
Line fit(const std::vector<RunResult>& runs, const Convergence& curve,
         std::span<const size_t> chosen, double deviations = 0.0) {
  const std::vector<size_t> points = fittedPoints(curve);
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const double n = double(points.size());
  for (const size_t point : points) {
    double timeMs = 0.0, mse = 0.0;
    for (const size_t run : chosen) {
      timeMs += runs[run].accumulated[point].timeMs;
      mse += runs[run].accumulated[point].error.mse;
    }
    // NaN, and so an unknown interval, where fewer runs leave no positive error.
    const double logTime = std::log(timeMs / double(chosen.size()));
    const double logMse =
        std::log(mse / double(chosen.size()) + deviations * curve.points[point].noise);
    x += logTime;
    y += logMse;
    xx += logTime * logTime;
    xy += logTime * logMse;
  }
  Line line;
  const double spread = n * xx - x * x;
  if (points.size() < 2 || !(spread > 0.0)) return line;
  line.slope = (n * xy - x * y) / spread;
  line.intercept = (y - line.slope * x) / n;
  return line;
}

std::vector<size_t> everyRun(size_t runs) {
  std::vector<size_t> all(runs);
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

// The jackknife's over runs, and what one standard deviation of the reference's noise, up or down,
// moves. Points that are fitted are above two of them.
template <class Statistic>
Interval intervalOf(size_t runs, const Statistic& statistic) {
  const std::vector<size_t> all = everyRun(runs);
  const double value = statistic(all, 0.0);
  const double moved =
      std::max(std::abs(statistic(all, 1.0) - value), std::abs(statistic(all, -1.0) - value));
  return widened(jackknifeInterval(
                     runs, [&](std::span<const size_t> chosen) { return statistic(chosen, 0.0); }),
                 moved * moved);
}

Interval exponential(const Interval& of) {
  return {std::exp(of.value), std::exp(of.lo), std::exp(of.hi)};
}

}  // namespace

std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs,
                                         const AccumulatedNoise& noise) {
  if (runs.empty() || runs.front().accumulated.empty()) return std::nullopt;
  Convergence curve;
  for (size_t i = 0; i < runs.front().accumulated.size(); ++i) {
    std::vector<double> mse;
    double atMost = 0.0;
    ConvergencePoint point;
    point.frames = runs.front().accumulated[i].frames;
    for (const RunResult& run : runs) {
      mse.push_back(run.accumulated.at(i).error.mse);
      atMost += run.accumulated[i].error.mseVarianceAtMost;
      point.timeMs += run.accumulated[i].timeMs / double(runs.size());
    }
    const double variance =
        noise.isUnbiased ? noise.common
                         : std::max(atMost / double(runs.size()), noise.common);  // NaN stays
    point.noise = std::sqrt(variance);
    point.mse = widened(meanInterval(mse), variance);
    // With one run nothing is known of the interval.
    point.isFitted = std::isnan(point.mse.lo) ? point.mse.value > 0.0 : point.mse.lo > 0.0;
    curve.points.push_back(point);
  }
  curve.intercept = fit(runs, curve, everyRun(runs.size())).intercept;
  curve.slope = intervalOf(runs.size(), [&](std::span<const size_t> chosen, double deviations) {
    return fit(runs, curve, chosen, deviations).slope;
  });
  return curve;
}

std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method,
                                 const AccumulatedNoise& pathNoise,
                                 const AccumulatedNoise& methodNoise) {
  // An interrupted block may have one run more of the first methods.
  const size_t paired = std::min(path.size(), method.size());
  const std::vector<RunResult> a(path.begin(), path.begin() + std::ptrdiff_t(paired));
  const std::vector<RunResult> b(method.begin(), method.begin() + std::ptrdiff_t(paired));
  const std::optional<Convergence> curveA = convergenceOf(a, pathNoise),
                                   curveB = convergenceOf(b, methodNoise);
  if (!curveA || !curveB) return std::nullopt;
  const std::vector<size_t> all = everyRun(paired);
  const Line lineA = fit(a, *curveA, all), lineB = fit(b, *curveB, all);
  if (std::isnan(lineA.slope) || std::isnan(lineB.slope)) return std::nullopt;
  const double endA = std::log(curveA->points[fittedPoints(*curveA).back()].timeMs);
  const double endB = std::log(curveB->points[fittedPoints(*curveB).back()].timeMs);
  SpeedUp result;
  const double logTime = std::min(endA, endB);
  result.timeMs = std::exp(logTime);
  result.equalTime =
      exponential(intervalOf(paired, [&](std::span<const size_t> chosen, double deviations) {
        return fit(a, *curveA, chosen, deviations).at(logTime) -
               fit(b, *curveB, chosen, deviations).at(logTime);
      }));
  const double logMse = std::max(lineA.at(endA), lineB.at(endB));
  result.mse = std::exp(logMse);
  result.equalError =
      exponential(intervalOf(paired, [&](std::span<const size_t> chosen, double deviations) {
        return fit(a, *curveA, chosen, deviations).reaches(logMse) -
               fit(b, *curveB, chosen, deviations).reaches(logMse);
      }));
  return result;
}

}  // namespace restlab
