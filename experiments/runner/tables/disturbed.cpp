#include "experiments/runner/tables/disturbed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "experiments/report/text.h"

namespace restlab {

namespace {

// Reports a ratio of medians that differs from the ratio of pairs by more than this share.
constexpr double kRatiosDiffer = 0.05;

// Returns "gi 1.40 by medians and 1.28 by pairs"; "" if both agree or are unknown.
std::string ratiosOf(const MethodSummary& row) {
  const double apart = row.timeRatioOfMedians / row.timeRatio.value;
  if (row.isBaseline || !(std::abs(apart - 1.0) > kRatiosDiffer)) return "";
  return fmt::format("{} {} by medians and {} by pairs", oneLine(row.method->name),
                     shortNumber(row.timeRatioOfMedians), shortNumber(row.timeRatio.value));
}

}  // namespace

double disturbance(const MethodSummary& row) {
  if (row.method->images || std::isnan(row.timeMsMedian)) return 0.0;
  const std::vector<RunResult>& runs = row.result->runs;
  std::vector<double> shares;
  for (size_t frame = 0; frame < runs.front().timesMs.size(); ++frame) {
    std::vector<double> others;
    for (const RunResult& run : runs)
      if (frame < run.timesMs.size()) others.push_back(run.timesMs[frame]);
    if (runs.size() == 1) others = runs.front().timesMs;
    const double middle = median(others);
    for (const RunResult& run : runs)
      if (frame < run.timesMs.size()) shares.push_back(run.timesMs[frame] / middle - 1.0);
  }
  return shares.empty() ? 0.0 : percentile(shares, 0.95);
}

std::string disturbedNote(const std::vector<MethodSummary>& rows) {
  std::vector<std::string> names, ratios;
  double worst = 0.0;
  for (const MethodSummary& row : rows) {
    const double own = disturbance(row);
    if (own <= kDisturbed) continue;
    worst = std::max(worst, own);
    names.push_back(oneLine(row.method->name));
    const std::string ratio = ratiosOf(row);
    if (!ratio.empty()) ratios.push_back(ratio);
  }
  if (names.empty()) return "";
  const bool areAll = names.size() == rows.size();
  return fmt::format(
      "- the machine was disturbed: one frame in twenty took up to {} times as long as the same "
      "frame of other runs, in {}{}; times hold less than their intervals say, measure again on a "
      "quiet machine\n",
      shortNumber(1.0 + worst),
      areAll ? std::string("all rows") : fmt::format("{}", fmt::join(names, "; ")),
      ratios.empty() ? "" : fmt::format("; ratios of times: {}", fmt::join(ratios, ", ")));
}

std::string timesExplained() {
  return "A time is the median over all timed frames. The ratio in brackets is that of pairs: in "
         "each run the median over frames of the time over that of the baseline's frame made "
         "beside it, then the geometric mean over runs. What slows the machine for a while is in "
         "both of a pair, so the ratio of the two medians may differ from it.";
}

}  // namespace restlab
