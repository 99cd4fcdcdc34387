#include "experiments/runner/compare_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "experiments/runner/job.h"
#include "experiments/runner/report.h"
#include "experiments/runner/run_record.h"

namespace restlab {

namespace {

struct Table {
  const Suite* suite = nullptr;
  BlockResult block;
  std::vector<MethodSummary> rows;
  std::string reference;  // hash of its pixels
};

std::map<std::string, Table> tablesOf(const ResultsFolder& results) {
  std::map<std::string, Table> tables;
  for (const PlannedBlock& planned : results.plan) {
    if (planned.jobs.empty() && planned.images.empty()) continue;
    const Suite& suite = suiteOf(results, planned);
    Table table;
    table.suite = &suite;
    table.block = loadBlock(results, planned).result;
    if (table.block.methods.empty()) continue;
    table.reference = referenceHash(table.block.reference);
    table.block.reference.variance.reset();
    const std::string label = blockLabel(suite, table.block);
    Table& placed = tables.emplace(label, std::move(table)).first->second;
    placed.rows = summarise(suite, placed.block);
    placed.block.reference.mean = Image();
    for (MethodResult& method : placed.block.methods) {
      method.measured = BiasRuns();
      method.shown = Image();
    }
  }
  return tables;
}

const MethodSummary* find(const Table& table, const std::string& name) {
  for (const MethodSummary& row : table.rows) {
    if (row.method->name == name) return &row;
  }
  return nullptr;
}

bool hasSameSeeds(const std::vector<RunResult>& a, const std::vector<RunResult>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const RunResult& x, const RunResult& y) { return x.seed == y.seed; });
}

std::vector<double> msesOf(const std::vector<RunResult>& runs) {
  std::vector<double> all;
  for (const RunResult& run : runs) all.push_back(run.measured.mse);
  return all;
}

bool haveTimes(const std::vector<RunResult>& runs) {
  return std::none_of(runs.begin(), runs.end(),
                      [](const RunResult& run) { return run.timesMs.empty(); });
}

// One number a run: its median time, over that of `path` frame by frame where there is one.
std::vector<double> timesOf(const std::vector<RunResult>& runs,
                            const std::vector<RunResult>* path) {
  std::vector<double> all;
  for (size_t r = 0; r < runs.size(); ++r) {
    std::vector<double> times = runs[r].timesMs;
    for (size_t i = 0; path != nullptr && i < times.size(); ++i)
      times[i] /= path->at(r).timesMs.at(i);
    all.push_back(median(times));
  }
  return all;
}

const std::vector<RunResult>* yardstickRuns(const Table& table, const MethodSummary& row) {
  if (row.isYardstick || row.method->images) return nullptr;
  const size_t path = table.suite->yardstick(size_t(row.method - table.suite->methods.data()));
  if (path >= table.block.methods.size()) return nullptr;
  const std::vector<RunResult>& runs = table.block.methods[path].runs;
  return runs.size() >= row.result->runs.size() ? &runs : nullptr;
}

// `ratio` above 1 is better.
std::string verdict(const Interval& ratio) {
  if (ratio.value == 1.0 && ratio.lo == 1.0 && ratio.hi == 1.0) return "the same";
  if (ratio.lo > 1.0) return "better";
  if (ratio.hi < 1.0) return "worse";
  return "not told apart";
}

ComparedRow compareRows(const std::string& label, const Table& a, const MethodSummary& before,
                        const Table& b, const MethodSummary& after) {
  ComparedRow row;
  row.table = label;
  row.method = before.method->name;
  row.before = before.mse;
  row.after = after.mse;
  const std::vector<RunResult>& runsA = before.result->runs;
  const std::vector<RunResult>& runsB = after.result->runs;
  const std::vector<double> mseA = msesOf(runsA), mseB = msesOf(runsB);
  // Images have no seeds.
  const bool isPaired = !before.method->images && hasSameSeeds(runsA, runsB);
  SharedNoise shared = sharedNoise(before.noise, after.noise, mseA == mseB);
  if (a.reference != b.reference) shared.covariance = 0.0;
  row.mseRatio =
      isPaired ? pairedRatioInterval(mseA, mseB, shared) : ratioInterval(mseA, mseB, shared);
  row.errorVerdict = verdict(row.mseRatio);
  if (!haveTimes(runsA) || !haveTimes(runsB)) {
    row.timeRatio = {kUnknown, kUnknown, kUnknown};
    row.timeVerdict = "not known";
    return row;
  }
  const std::vector<RunResult>* pathA = yardstickRuns(a, before);
  const std::vector<RunResult>* pathB = yardstickRuns(b, after);
  row.timesOverPath = pathA != nullptr && pathB != nullptr;
  const auto timesA = timesOf(runsA, row.timesOverPath ? pathA : nullptr);
  const auto timesB = timesOf(runsB, row.timesOverPath ? pathB : nullptr);
  row.timeRatio = ratioInterval(timesB, timesA);
  // Less time is better.
  row.timeVerdict =
      verdict({1.0 / row.timeRatio.value, 1.0 / row.timeRatio.hi, 1.0 / row.timeRatio.lo});
  return row;
}

std::string text(const Interval& interval) {
  const bool isKnown = std::isfinite(interval.lo) && std::isfinite(interval.hi);
  return fmt::format(
      "{:.4g}{}", interval.value,
      isKnown ? fmt::format(" [{:.4g}, {:.4g}]", interval.lo, interval.hi) : " [unknown]");
}

nlohmann::ordered_json json(const Interval& interval) {
  return {{"value", finiteJson(interval.value)},
          {"lo", finiteJson(interval.lo)},
          {"hi", finiteJson(interval.hi)}};
}

// Whatever else ran on the machine is in the times, also in those over `path`.
void noteLoads(const ResultsFolder& first, const ResultsFolder& second,
               FolderComparison& comparison) {
  const double before = first.record.at("machine").at("load_1min").get<double>();
  const double after = second.record.at("machine").at("load_1min").get<double>();
  const double cores = second.record.at("machine").at("cores").get<double>();
  if (std::abs(after - before) < 0.5 && std::max(before, after) < cores + 0.5) return;
  comparison.notes.push_back(
      fmt::format("the machine's load was {:.1f} and {:.1f} on {:.0f} cores: what ran beside is in "
                  "the times; measure again on a quiet one",
                  before, after, cores));
}

}  // namespace

FolderComparison compareFolders(const std::filesystem::path& before,
                                const std::filesystem::path& after) {
  const ResultsFolder first = openResults(before), second = openResults(after);
  const std::map<std::string, Table> a = tablesOf(first), b = tablesOf(second);
  FolderComparison comparison;
  noteLoads(first, second, comparison);
  const auto only = [&](const std::string& what, const std::filesystem::path& folder) {
    comparison.notes.push_back(fmt::format("{}: only in {}", what, folder.string()));
  };
  for (const auto& [label, table] : a) {
    const auto other = b.find(label);
    if (other == b.end()) {
      only(label, before);
      continue;
    }
    if (table.reference != other->second.reference) {
      comparison.notes.push_back(
          fmt::format("{}: the two are measured against different references", label));
    }
    for (const MethodSummary& row : table.rows) {
      if (const MethodSummary* same = find(other->second, row.method->name)) {
        comparison.rows.push_back(compareRows(label, table, row, other->second, *same));
      } else {
        only(fmt::format("{}, {}", label, row.method->name), before);
      }
    }
    for (const MethodSummary& row : other->second.rows) {
      if (find(table, row.method->name) == nullptr)
        only(fmt::format("{}, {}", label, row.method->name), after);
    }
  }
  for (const auto& [label, table] : b) {
    if (a.count(label) == 0) only(label, after);
  }
  if (comparison.rows.empty()) {
    failInput(fmt::format("{} and {} have no method of a table in common", before.string(),
                          after.string()));
  }
  return comparison;
}

std::string comparisonTable(const FolderComparison& comparison) {
  std::string lines =
      "| table | method | MSE before | MSE after | MSE before / after | | time after / before | |\n"
      "|---|---|---|---|---|---|---|---|\n";
  bool overPath = false;
  for (const ComparedRow& row : comparison.rows) {
    overPath = overPath || row.timesOverPath;
    lines += fmt::format("| {} | {} | {} | {} | {} | {} | {}{} | {} |\n", row.table, row.method,
                         text(row.before), text(row.after), text(row.mseRatio), row.errorVerdict,
                         text(row.timeRatio), row.timesOverPath ? " (*)" : "", row.timeVerdict);
  }
  if (overPath || !comparison.notes.empty()) lines += "\n";
  if (overPath) lines += "- (*) of the times over those of `path` in the same folder\n";
  for (const std::string& note : comparison.notes) lines += "- " + note + "\n";
  return lines;
}

nlohmann::ordered_json comparisonJson(const FolderComparison& comparison) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ComparedRow& row : comparison.rows) {
    rows.push_back({{"table", row.table},
                    {"method", row.method},
                    {"mse_before", json(row.before)},
                    {"mse_after", json(row.after)},
                    {"mse_ratio", json(row.mseRatio)},
                    {"error", row.errorVerdict},
                    {"time_ratio", json(row.timeRatio)},
                    {"times_over_path", row.timesOverPath},
                    {"time", row.timeVerdict}});
  }
  return {{"rows", rows}, {"notes", comparison.notes}};
}

}  // namespace restlab
