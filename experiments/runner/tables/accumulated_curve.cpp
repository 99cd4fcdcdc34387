#include "experiments/runner/tables/accumulated_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/nan.h"

namespace restlab {

namespace {

double slopeBetween(const CurvePoint& a, const CurvePoint& b) {
  return (b.logMse - a.logMse) / (b.logTime - a.logTime);
}

}  // namespace

double varianceOfPoint(const std::vector<RunResult>& runs, std::span<const size_t> chosen,
                       size_t point, const AccumulatedNoise& noise) {
  if (noise.isUnbiased) return noise.common;
  double atMost = 0.0;
  for (const size_t run : chosen)
    atMost += runs[run].accumulated.at(point).error.mseVarianceAtMost / double(chosen.size());
  return std::max(atMost, noise.common);  // keeps NaN
}

AccumulatedCurve accumulatedCurve(const std::vector<RunResult>& runs,
                                  std::span<const size_t> chosen, const AccumulatedNoise& noise,
                                  double deviations) {
  AccumulatedCurve curve;
  for (size_t point = 0; point < runs.front().accumulated.size(); ++point) {
    double timeMs = 0.0, mse = 0.0;
    for (const size_t run : chosen) {
      timeMs += runs[run].accumulated.at(point).timeMs / double(chosen.size());
      mse += runs[run].accumulated[point].error.mse / double(chosen.size());
    }
    const double deviation = std::sqrt(varianceOfPoint(runs, chosen, point, noise));
    if (!(timeMs > 0.0 && mse > 0.0) || mse <= kNoiseOfFittedErrors * deviation) continue;
    const double moved = deviations == 0.0 ? mse : mse + deviations * deviation;
    curve.push_back({point, std::log(timeMs), std::log(moved)});
  }
  return curve;
}

std::vector<size_t> everyRun(size_t runs) {
  std::vector<size_t> all(runs);
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

std::vector<Interval> curveIntervals(size_t runs, const CurveStatistics& statistics,
                                     double confidence) {
  const std::vector<size_t> all = everyRun(runs);
  const std::vector<double> up = statistics(all, 1.0), down = statistics(all, -1.0);
  std::vector<Interval> intervals = jackknifeIntervals(
      runs, [&](std::span<const size_t> chosen) { return statistics(chosen, 0.0); }, confidence);
  for (size_t i = 0; i < intervals.size(); ++i) {
    const double value = intervals[i].value;
    const double moved = std::max(std::abs(up[i] - value), std::abs(down[i] - value));
    intervals[i] = widened(intervals[i], moved * moved, confidence);
  }
  return intervals;
}

CurveLine fitLine(const AccumulatedCurve& curve) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const double n = double(curve.size());
  for (const CurvePoint& point : curve) {
    x += point.logTime;
    y += point.logMse;
    xx += point.logTime * point.logTime;
    xy += point.logTime * point.logMse;
  }
  CurveLine line;
  const double spread = n * xx - x * x;
  if (curve.size() < 2 || !(spread > 0.0)) return line;
  line.slope = (n * xy - x * y) / spread;
  line.intercept = (y - line.slope * x) / n;
  return line;
}

double interpolatedError(const AccumulatedCurve& curve, double logTime) {
  if (curve.size() < 2) return kNan;
  size_t i = 1;
  while (i + 1 < curve.size() && curve[i].logTime < logTime) ++i;
  return curve[i].logMse + slopeBetween(curve[i - 1], curve[i]) * (logTime - curve[i].logTime);
}

double interpolatedTime(const AccumulatedCurve& curve, double logMse) {
  if (curve.size() < 2) return kNan;
  size_t i = 1;
  while (i + 1 < curve.size() && curve[i].logMse > logMse) ++i;
  const double slope = slopeBetween(curve[i - 1], curve[i]);
  return slope < 0.0 ? curve[i].logTime + (logMse - curve[i].logMse) / slope : kNan;
}

}  // namespace restlab
