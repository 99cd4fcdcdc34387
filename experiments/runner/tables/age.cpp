#include "experiments/runner/tables/age.h"

#include <algorithm>
#include <cmath>

#include "core/base/nan.h"

namespace restlab {

namespace {

constexpr Interval kNothing{kNan, kNan, kNan};

std::vector<double> perRun(const std::vector<RunResult>& runs, size_t point, size_t count,
                           double (*value)(const AgedError&)) {
  std::vector<double> values;
  for (size_t r = 0; r < count; ++r) values.push_back(value(runs[r].aged.at(point)));
  return values;
}

double mseOf(const AgedError& aged) { return aged.error.mse; }
double timeOf(const AgedError& aged) { return aged.timeMs; }

Interval ratioOf(const AgeBaseline& own, const AgeBaseline& other, size_t point) {
  if (!other.runs) return kNothing;
  const size_t paired = std::min(own.runs->size(), other.runs->size());
  const std::vector<double> mse = perRun(*own.runs, point, paired, mseOf);
  const std::vector<double> others = perRun(*other.runs, point, paired, mseOf);
  return ratioOfPositives(
      pairedRatioInterval(others, mse, sharedNoise(other.noise, own.noise, mse == others)));
}

}  // namespace

std::vector<AgeSummary> agesOf(const AgeBaseline& own, const AgeBaseline& baseline,
                               const AgeBaseline& average) {
  std::vector<AgeSummary> ages;
  const std::vector<RunResult>& runs = *own.runs;
  for (size_t point = 0; point < runs.front().aged.size(); ++point) {
    AgeSummary age;
    age.age = runs.front().aged[point].age;
    age.mse = widened(meanInterval(perRun(runs, point, runs.size(), mseOf)), own.noise.shared);
    age.mseRatio = ratioOf(own, baseline, point);
    age.ratioToAverage = ratioOf(own, average, point);
    age.timeRatio = kNothing;
    if (baseline.runs && !std::isnan(runs.front().aged[point].timeMs)) {
      const size_t paired = std::min(runs.size(), baseline.runs->size());
      std::vector<double> ratios = perRun(runs, point, paired, timeOf);
      const std::vector<double> times = perRun(*baseline.runs, point, paired, timeOf);
      for (size_t r = 0; r < paired; ++r) ratios[r] /= times[r];
      age.timeRatio = geometricMeanInterval(ratios);
    }
    ages.push_back(age);
  }
  return ages;
}

}  // namespace restlab
