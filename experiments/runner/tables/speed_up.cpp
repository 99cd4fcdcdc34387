#include "experiments/runner/tables/speed_up.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/nan.h"
#include "experiments/runner/tables/accumulated_curve.h"
#include "experiments/runner/tables/convergence.h"

namespace restlab {

namespace {

struct Range {
  double lo = 0.0, hi = 0.0;
};

Range timesOf(const AccumulatedCurve& curve) {
  return {curve.front().logTime, curve.back().logTime};
}

// Range of errors covered both by the measured points and by the line between its end points.
Range errorsOf(const AccumulatedCurve& curve) {
  const auto [least, most] = std::minmax_element(
      curve.begin(), curve.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.logMse < b.logMse; });
  const CurveLine line = fitLine(curve);
  return {std::max(least->logMse, line.at(curve.back().logTime)),
          std::min(most->logMse, line.at(curve.front().logTime))};
}

// Paired runs of both methods, from which ratios are read.
struct Pair {
  std::vector<RunResult> path, method;
  AccumulatedNoise pathNoise, methodNoise;

  // Reads the value of a curve: on its fitted line, or between its points.
  using Read = std::function<double(const AccumulatedCurve&, bool isFitted)>;
  CurveReading read(double at, const Read& value) const {
    const auto logRatios = [&](std::span<const size_t> chosen, double deviations) {
      const AccumulatedCurve a = accumulatedCurve(path, chosen, pathNoise, deviations);
      const AccumulatedCurve b = accumulatedCurve(method, chosen, methodNoise, deviations);
      const double fitted = value(a, true) - value(b, true);
      const double measured = value(a, false) - value(b, false);
      return std::vector<double>{fitted, measured, fitted - measured};
    };
    const std::vector<Interval> of = curveIntervals(path.size(), logRatios);
    CurveReading reading;
    reading.ratio = exponential(of[0]);
    reading.measured = exponential(of[1]);
    const bool isMore = std::abs(of[2].value) > kMisfitMin * std::numbers::ln10;
    reading.isOffTheLines = isMore && (of[2].lo > 0.0 || of[2].hi < 0.0);
    reading.at = std::exp(at);
    return reading;
  }
};

CurveReading unread(const std::string& why) {
  const Interval unknown{kNan, kNan, kNan};
  return {unknown, unknown, kNan, false, why};
}

CurveReading readAtEqualTime(const Pair& pair, const AccumulatedCurve& a,
                             const AccumulatedCurve& b) {
  const Range timesA = timesOf(a), timesB = timesOf(b);
  const double time = std::min(timesA.hi, timesB.hi);
  if (time < std::max(timesA.lo, timesB.lo))
    return unread("outside the measured range: one curve ends before the other begins");
  return pair.read(time, [time](const AccumulatedCurve& curve, bool isFitted) {
    return isFitted ? fitLine(curve).at(time) : interpolatedError(curve, time);
  });
}

CurveReading readToEqualError(const Pair& pair, const AccumulatedCurve& a,
                              const AccumulatedCurve& b) {
  if (!isFalling(convergenceOf(pair.path, pair.pathNoise)->slope))
    return unread("the error of the baseline does not fall");
  if (!isFalling(convergenceOf(pair.method, pair.methodNoise)->slope))
    return unread("its error does not fall");
  const Range errorsA = errorsOf(a), errorsB = errorsOf(b);
  const double error = std::max(errorsA.lo, errorsB.lo);
  if (error > std::min(errorsA.hi, errorsB.hi))
    return unread("outside the measured range: no error was measured of both");
  return pair.read(error, [error](const AccumulatedCurve& curve, bool isFitted) {
    return isFitted ? fitLine(curve).reaches(error) : interpolatedTime(curve, error);
  });
}

bool hasTimes(const std::vector<RunResult>& runs) {
  return !runs.empty() && !runs.front().accumulated.empty() &&
         !std::isnan(runs.front().accumulated.front().timeMs);
}

}  // namespace

std::optional<SpeedUp> speedUpOf(const std::vector<RunResult>& path,
                                 const std::vector<RunResult>& method,
                                 const AccumulatedNoise& pathNoise,
                                 const AccumulatedNoise& methodNoise) {
  if (!hasTimes(path) || !hasTimes(method)) return std::nullopt;
  // An interrupted block may have one more run of the first methods.
  const auto paired = std::ptrdiff_t(std::min(path.size(), method.size()));
  const Pair pair = {{path.begin(), path.begin() + paired},
                     {method.begin(), method.begin() + paired},
                     pathNoise,
                     methodNoise};
  const std::vector<size_t> all = everyRun(pair.path.size());
  const AccumulatedCurve a = accumulatedCurve(pair.path, all, pathNoise);
  const AccumulatedCurve b = accumulatedCurve(pair.method, all, methodNoise);
  if (a.size() < 2 || b.size() < 2) {
    const CurveReading none = unread("fewer than two points are above the noise of the reference");
    return SpeedUp{none, none};
  }
  return SpeedUp{readAtEqualTime(pair, a, b), readToEqualError(pair, a, b)};
}

}  // namespace restlab
