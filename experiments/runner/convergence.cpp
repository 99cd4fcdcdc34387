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

// Least squares over the given points of the means over these runs.
Line fit(const std::vector<RunResult>& runs, const std::vector<size_t>& points,
         std::span<const size_t> chosen) {
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
    const double logMse = std::log(mse / double(chosen.size()));
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

std::vector<size_t> fittedPoints(const Convergence& curve) {
  std::vector<size_t> points;
  for (size_t i = 0; i < curve.points.size(); ++i) {
    if (curve.points[i].isFitted) points.push_back(i);
  }
  return points;
}

std::vector<size_t> everyRun(size_t runs) {
  std::vector<size_t> all(runs);
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

Interval exponential(const Interval& of) {
  return {std::exp(of.value), std::exp(of.lo), std::exp(of.hi)};
}

}  // namespace

std::optional<Convergence> convergenceOf(const std::vector<RunResult>& runs) {
  if (runs.empty() || runs.front().accumulated.empty()) return std::nullopt;
  Convergence curve;
  for (size_t i = 0; i < runs.front().accumulated.size(); ++i) {
    std::vector<double> mse;
    ConvergencePoint point;
    point.frames = runs.front().accumulated[i].frames;
    for (const RunResult& run : runs) {
      mse.push_back(run.accumulated.at(i).error.mse);
      point.timeMs += run.accumulated[i].timeMs / double(runs.size());
    }
    point.mse = meanInterval(mse);
    // With one run nothing is known of the interval.
    point.isFitted = std::isnan(point.mse.lo) ? point.mse.value > 0.0 : point.mse.lo > 0.0;
    curve.points.push_back(point);
  }
  const std::vector<size_t> points = fittedPoints(curve);
  curve.intercept = fit(runs, points, everyRun(runs.size())).intercept;
  curve.slope = jackknifeInterval(
      runs.size(), [&](std::span<const size_t> chosen) { return fit(runs, points, chosen).slope; });
  return curve;
}

std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method) {
  // An interrupted block may have one run more of the first methods.
  const size_t paired = std::min(path.size(), method.size());
  const std::vector<RunResult> a(path.begin(), path.begin() + std::ptrdiff_t(paired));
  const std::vector<RunResult> b(method.begin(), method.begin() + std::ptrdiff_t(paired));
  const std::optional<Convergence> curveA = convergenceOf(a), curveB = convergenceOf(b);
  if (!curveA || !curveB) return std::nullopt;
  const std::vector<size_t> pointsA = fittedPoints(*curveA), pointsB = fittedPoints(*curveB);
  const std::vector<size_t> all = everyRun(paired);
  const Line lineA = fit(a, pointsA, all), lineB = fit(b, pointsB, all);
  if (std::isnan(lineA.slope) || std::isnan(lineB.slope)) return std::nullopt;
  const double endA = std::log(curveA->points[pointsA.back()].timeMs);
  const double endB = std::log(curveB->points[pointsB.back()].timeMs);
  SpeedUp result;
  const double logTime = std::min(endA, endB);
  result.timeMs = std::exp(logTime);
  result.equalTime = exponential(jackknifeInterval(paired, [&](std::span<const size_t> chosen) {
    return fit(a, pointsA, chosen).at(logTime) - fit(b, pointsB, chosen).at(logTime);
  }));
  const double logMse = std::max(lineA.at(endA), lineB.at(endB));
  result.mse = std::exp(logMse);
  result.equalError = exponential(jackknifeInterval(paired, [&](std::span<const size_t> chosen) {
    return fit(a, pointsA, chosen).reaches(logMse) - fit(b, pointsB, chosen).reaches(logMse);
  }));
  return result;
}

}  // namespace restlab
