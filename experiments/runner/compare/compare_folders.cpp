#include "experiments/runner/compare/compare_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "experiments/runner/reference/reference_noise.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/tables/disturbed.h"

namespace restlab {

namespace {

// With fewer runs the spread of times is itself a guess.
constexpr uint32_t kFewestTimedRuns = 4;

struct Table {
  const Suite* suite = nullptr;
  BlockResult block;
  std::vector<MethodSummary> rows;
  std::map<std::string, Words> words;  // by method name
  std::string reference;               // hash of the reference's pixels
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
    table.words = blockWords(results, planned, table.block.reference);
    table.reference = referenceHash(table.block.reference);
    const std::string label = blockLabel(suite, table.block);
    Table& placed = tables.emplace(label, std::move(table)).first->second;
    placed.rows = summarise(suite, placed.block);
    placed.block.reference.mean = Image();
    placed.block.reference.variance.reset();
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

struct Mses {
  std::vector<double> before, after;  // one value per run
};

// Pairs runs of the same seed. Returns nothing if a run of the smaller set has no partner.
std::optional<Mses> pairedMses(const std::vector<RunResult>& before,
                               const std::vector<RunResult>& after) {
  Mses pairs;
  for (const RunResult& x : before) {
    for (const RunResult& y : after) {
      if (x.seed != y.seed) continue;
      pairs.before.push_back(x.measured.mse);
      pairs.after.push_back(y.measured.mse);
    }
  }
  if (pairs.before.size() < std::min(before.size(), after.size())) return std::nullopt;
  return pairs;
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

// Returns the median frame time of each run. If `path` (the baseline) is given, each frame's time
// is first divided by that of the baseline's run with the same index.
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

const std::vector<RunResult>* baselineRuns(const Table& table, const MethodSummary& row) {
  if (row.isBaseline || row.method->images) return nullptr;
  const size_t path = table.suite->baselineOf(size_t(row.method - table.suite->methods.data()));
  if (path >= table.block.methods.size()) return nullptr;
  const std::vector<RunResult>& runs = table.block.methods[path].runs;
  return runs.size() >= row.result->runs.size() ? &runs : nullptr;
}

std::string baselineName(const Table& table, const MethodSummary& row) {
  const size_t index = table.suite->baselineOf(size_t(row.method - table.suite->methods.data()));
  return index < table.suite->methods.size() ? table.suite->methods[index].name : "";
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
  const bool haveSeeds = !before.method->images && !after.method->images;
  std::optional<Mses> pairs;
  if (haveSeeds) pairs = pairedMses(runsA, runsB);
  const Mses mses = pairs ? *pairs : Mses{msesOf(runsA), msesOf(runsB)};
  const bool areSame = mses.before == mses.after;
  SharedNoise shared = sharedNoise(after.noise, before.noise, areSame);
  if (a.reference != b.reference) shared.covariance = 0.0;
  row.mseRatio = ratioOfPositives(pairs ? pairedRatioInterval(mses.after, mses.before, shared)
                                        : ratioInterval(mses.after, mses.before, shared));
  if ((pairs || !haveSeeds) && areSame)
    row.mseRatio = {1.0, 1.0, 1.0};  // exact, however few runs there are
  if (haveSeeds && !pairs) {
    row.runsOfRatio = "of runs that are not paired, as their seeds differ";
  } else if (haveSeeds && runsA.size() != runsB.size()) {
    row.runsOfRatio = fmt::format("of the {} runs whose seeds both have", mses.after.size());
  }
  row.error = verdictOf(row.mseRatio);
  row.timeRatio = {kUnknown, kUnknown, kUnknown};
  if (!haveTimes(runsA) || !haveTimes(runsB)) return row;
  const std::vector<RunResult>* pathA = baselineRuns(a, before);
  const std::vector<RunResult>* pathB = baselineRuns(b, after);
  const bool isSamePath =
      pathA != nullptr && pathB != nullptr && baselineName(a, before) == baselineName(b, after);
  if (isSamePath) row.timesOver = baselineName(a, before);
  const auto timesA = timesOf(runsA, isSamePath ? pathA : nullptr);
  const auto timesB = timesOf(runsB, isSamePath ? pathB : nullptr);
  row.timeRatio = geometricRatioInterval(timesB, timesA);
  row.time = verdictOf(row.timeRatio);
  return row;
}

// Returns why the times get no verdict, "" if they get one. Images are not warned about: another
// program measured their times.
std::string whyTimesAreNotJudged(const ComparedRow& row, const MethodSummary& before,
                                 const MethodSummary& after, const FolderComparison& comparison) {
  if (row.time == Verdict::notKnown || before.method->images || after.method->images) return "";
  if (!comparison.loads.empty()) return comparison.loads;
  const uint32_t runs = std::min(before.runs, after.runs);
  if (runs < kFewestTimedRuns)
    return fmt::format("of fewer than {} runs an interval of times says little", kFewestTimedRuns);
  const double disturbed = std::max(disturbance(before), disturbance(after));
  if (disturbed > kDisturbed) {
    return fmt::format(
        "one frame in twenty took {:.1f} times as long as the same one of other "
        "runs: the machine was disturbed",
        1.0 + disturbed);
  }
  if (comparison.isOneProgram && row.unlike.empty())
    return "the program and its settings are the same: times of two hours differ by the machine "
           "alone";
  return "";
}

// Adds one note for all rows of a table that share a reason.
void noteTimes(const std::string& label, const std::map<std::string, std::vector<std::string>>& why,
               size_t rows, FolderComparison& comparison) {
  for (const auto& [reason, methods] : why) {
    const bool areAll = methods.size() == rows;
    comparison.notes.push_back(
        fmt::format("{}{}: times are not judged: {}", label,
                    areAll ? "" : fmt::format(", {}", fmt::join(methods, "; ")), reason));
  }
}

// Notes a difference in machine load: other processes slow frames down, and ratios over the
// baseline too.
void noteLoads(const ResultsFolder& first, const ResultsFolder& second,
               FolderComparison& comparison) {
  const double before = first.record.at("machine").at("load_1min").get<double>();
  const double after = second.record.at("machine").at("load_1min").get<double>();
  if (before < 0.0 || after < 0.0) return;  // unknown
  const double cores = second.record.at("machine").at("cores").get<double>();
  if (std::abs(after - before) < 0.5 && std::max(before, after) < cores + 0.5) return;
  comparison.loads = fmt::format(
      "the machine's load was {:.1f} and {:.1f} on {:.0f} cores: what ran beside is in "
      "the times, which are not judged; measure again on a quiet one",
      before, after, cores);
  comparison.notes.push_back(comparison.loads);
}

// Notes who made the folders and whether both are complete.
void noteOrigins(FolderComparison& comparison) {
  const std::vector<std::string> differences =
      originDifferences(comparison.before, comparison.after);
  comparison.isOneProgram = differences.empty();
  if (!differences.empty())
    comparison.notes.push_back(fmt::format("made differently: {}", fmt::join(differences, ", ")));
  for (const FolderOrigin* origin : {&comparison.before, &comparison.after}) {
    if (origin->status == "finished") continue;
    comparison.notes.push_back(
        fmt::format("{}: is not finished ({}): runs are missing", origin->folder, origin->status));
  }
}

void noteDifferences(const std::string& where, const std::vector<Difference>& differences,
                     FolderComparison& comparison) {
  for (const bool areSettings : {true, false}) {
    std::vector<std::string> texts;
    for (const Difference& difference : differences) {
      if (difference.isSetting == areSettings) texts.push_back(difference.text);
    }
    if (texts.empty()) continue;
    comparison.notes.push_back(fmt::format("{}: {}: {}", where,
                                           areSettings ? "settings differ" : "differ as well",
                                           fmt::join(texts, ", ")));
  }
}

// Notes different baselines: times over two baselines cannot be compared.
void noteBaselines(const std::string& label, const Table& a, const Table& b,
                   FolderComparison& comparison) {
  const std::string before = a.suite->baselineName(), after = b.suite->baselineName();
  if (before == after) return;
  comparison.notes.push_back(
      fmt::format("{}: the baseline is '{}' before and '{}' after: times are not over it; run the "
                  "suite again with --set baseline=NAME for both",
                  label, before.empty() ? "none" : before, after.empty() ? "none" : after));
}

// Compares two tables. Notes a difference once if all rows of the table have it.
void compareTables(const std::string& label, const Table& a, const Table& b,
                   FolderComparison& comparison) {
  std::vector<std::pair<std::string, std::vector<Difference>>> differences;
  std::map<std::string, size_t> counts;
  std::map<std::string, std::vector<std::string>> ratios;     // text on the paired runs -> methods
  std::map<std::string, std::vector<std::string>> notJudged;  // reason -> methods
  for (const MethodSummary& row : a.rows) {
    const std::string& name = row.method->name;
    const MethodSummary* same = find(b, name);
    if (same == nullptr) continue;
    ComparedRow& compared = comparison.rows.emplace_back(compareRows(label, a, row, b, *same));
    if (!compared.runsOfRatio.empty()) ratios[compared.runsOfRatio].push_back(name);
    const auto& own =
        differences.emplace_back(name, differencesOf(a.words.at(name), b.words.at(name))).second;
    for (const Difference& difference : own) {
      ++counts[difference.text];
      if (difference.isSetting) compared.unlike.push_back(difference.text);
    }
    compared.whyNoTime = whyTimesAreNotJudged(compared, row, *same, comparison);
    if (compared.whyNoTime.empty()) continue;
    compared.time = Verdict::notJudged;
    if (compared.whyNoTime != comparison.loads) notJudged[compared.whyNoTime].push_back(name);
  }
  noteTimes(label, notJudged, differences.size(), comparison);
  noteBaselines(label, a, b, comparison);
  for (const auto& [runs, methods] : ratios) {
    const bool areAll = methods.size() == differences.size();
    comparison.notes.push_back(
        fmt::format("{}{}: ratios of the MSE are {}", label,
                    areAll ? "" : fmt::format(", {}", fmt::join(methods, ", ")), runs));
  }
  if (differences.empty()) return;
  std::vector<Difference> common;
  for (const Difference& difference : differences.front().second) {
    if (counts[difference.text] == differences.size()) common.push_back(difference);
  }
  noteDifferences(label, common, comparison);
  for (auto& [name, own] : differences) {
    std::erase_if(own, [&](const Difference& difference) {
      return counts[difference.text] == differences.size();
    });
    noteDifferences(fmt::format("{}, {}", label, name), own, comparison);
  }
}

void noteOnly(const std::map<std::string, Table>& tables,
              const std::map<std::string, Table>& others, const std::filesystem::path& folder,
              FolderComparison& comparison) {
  const auto only = [&](const std::string& what) {
    comparison.notes.push_back(fmt::format("{}: only in {}", what, folder.string()));
  };
  for (const auto& [label, table] : tables) {
    const auto other = others.find(label);
    if (other == others.end()) {
      only(label);
      continue;
    }
    for (const MethodSummary& row : table.rows) {
      if (find(other->second, row.method->name) == nullptr)
        only(fmt::format("{}, {}", label, row.method->name));
    }
  }
}

}  // namespace

Verdict verdictOf(const Interval& afterOverBefore) {
  const auto& [value, lo, hi] = afterOverBefore;
  if (value == 1.0 && lo == 1.0 && hi == 1.0) return Verdict::same;
  if (!(lo > 0.0) || !std::isfinite(hi)) return Verdict::notToldApart;
  if (hi < 1.0) return Verdict::better;
  return lo > 1.0 ? Verdict::worse : Verdict::notToldApart;
}

FolderComparison compareFolders(const std::filesystem::path& before,
                                const std::filesystem::path& after) {
  const ResultsFolder first = openResults(before), second = openResults(after);
  const std::map<std::string, Table> a = tablesOf(first), b = tablesOf(second);
  FolderComparison comparison;
  comparison.before = originOf(first);
  comparison.after = originOf(second);
  noteOrigins(comparison);
  noteLoads(first, second, comparison);
  for (const auto& [label, table] : a) {
    const auto other = b.find(label);
    if (other != b.end()) compareTables(label, table, other->second, comparison);
  }
  noteOnly(a, b, before, comparison);
  noteOnly(b, a, after, comparison);
  if (comparison.rows.empty()) {
    failInput(fmt::format("{} and {} have no method of a table in common", before.string(),
                          after.string()));
  }
  return comparison;
}

}  // namespace restlab
