// Output of `compare DIR DIR`.
#include <fmt/format.h>

#include <set>

#include "experiments/report/text.h"
#include "experiments/runner/base/json_number.h"
#include "experiments/runner/compare/compare_folders.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kDigitsOfRuns = 4;

std::string text(const Interval& interval) {
  const std::string ends = intervalText(interval.lo, interval.hi, kDigitsOfRuns);
  return shortNumber(interval.value, kDigitsOfRuns) + (ends.empty() ? " [unknown]" : ends);
}

Json json(const Interval& interval) {
  return {{"value", finiteJson(interval.value)},
          {"lo", finiteJson(interval.lo)},
          {"hi", finiteJson(interval.hi)}};
}

Json json(const FolderOrigin& origin) {
  Json words = {{"folder", origin.folder}, {"status", origin.status}};
  for (const auto& [name, word] : origin.words) words[name] = word;
  return words;
}

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
      return "the same";
    case Verdict::better:
      return "better";
    case Verdict::worse:
      return "worse";
    case Verdict::notToldApart:
      return "not told apart";
    case Verdict::notJudged:
      return "not judged";
    case Verdict::notKnown:
      break;
  }
  return "not known";
}

}  // namespace

std::string ComparedRow::verdictText(Verdict verdict) const {
  return fmt::format("{}{}", unlike.empty() ? "" : "unlike things: ", name(verdict));
}

std::string comparisonTable(const FolderComparison& comparison) {
  std::string lines = fmt::format(
      "- before: {}\n- after: {}\n\n"
      "| table | method | MSE before | MSE after | MSE, after / before | | time, after / before | "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n",
      originText(comparison.before), originText(comparison.after));
  std::set<std::string> over;
  for (const ComparedRow& row : comparison.rows) {
    if (!row.timesOver.empty()) over.insert(row.timesOver);
    lines += fmt::format("| {} | {} | {} | {} | {} | {} | {}{} | {} |\n", row.table, row.method,
                         text(errorOf(row.before)), text(errorOf(row.after)), text(row.mseRatio),
                         row.verdictText(row.error), text(row.timeRatio),
                         row.timesOver.empty() ? "" : " (*)", row.verdictText(row.time));
  }
  lines += "\n- ratios below 1 are better\n";
  if (!over.empty()) {
    lines += fmt::format("- (*) of the times over those of `{}` in the same folder\n",
                         fmt::join(over, "` or `"));
  }
  for (const std::string& note : comparison.notes) lines += "- " + note + "\n";
  return lines;
}

Json comparisonJson(const FolderComparison& comparison) {
  Json rows = Json::array();
  for (const ComparedRow& row : comparison.rows) {
    rows.push_back({{"table", row.table},
                    {"method", row.method},
                    {"mse_before", json(row.before)},
                    {"mse_after", json(row.after)},
                    {"mse_after_over_before", json(row.mseRatio)},
                    {"mse_ratio_is", row.runsOfRatio},
                    {"error", row.verdictText(row.error)},
                    {"time_after_over_before", json(row.timeRatio)},
                    {"times_over", row.timesOver},
                    {"time_not_judged", row.whyNoTime},
                    {"time", row.verdictText(row.time)},
                    {"unlike", row.unlike},
                    {"is_worse", row.isWorse()}});
  }
  return {{"before", json(comparison.before)},
          {"after", json(comparison.after)},
          {"rows", rows},
          {"notes", comparison.notes}};
}

}  // namespace restlab
