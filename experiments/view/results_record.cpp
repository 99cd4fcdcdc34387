#include "experiments/view/results_record.h"

#include "experiments/runner/results/results_folder.h"
#include "experiments/runner/run/block_label.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

// Adds the times of a job's frames, by method.
void addTimes(const nlohmann::ordered_json& job,
              std::map<std::string, std::vector<double>>& times) {
  for (const nlohmann::ordered_json& method : job.at("methods")) {
    for (const nlohmann::ordered_json& line : method.at("lines")) {
      if (!line.contains("time_ms")) continue;
      const auto frames = line.at("time_ms").at("frames").get<std::vector<double>>();
      std::vector<double>& all = times[line.at("method").get<std::string>()];
      all.insert(all.end(), frames.begin(), frames.end());
    }
  }
}

RecordedTable tableOf(const ResultsFolder& results, const PlannedBlock& planned,
                      const std::string& timesOf) {
  const Suite& suite = suiteOf(results, planned);
  BlockResult block;
  block.scene = planned.scene;
  block.component = parseComponent(planned.component, "run.json");
  RecordedTable table{blockLabel(suite, block), {}, {}};
  for (const SuiteMethod& method : suite.methods) table.methods.push_back(method.name);
  if (table.label != timesOf) return table;
  const JobStore store(results.folder);
  std::map<std::string, std::vector<double>> times;
  for (const auto* keys : {&planned.jobs, &planned.images})
    for (const std::string& key : *keys)
      if (const auto job = store.record(key)) addTimes(*job, times);
  for (const auto& [method, all] : times)
    if (!all.empty()) table.msOf[method] = median(all);
  return table;
}

}  // namespace

std::vector<RecordedTable> recordedTables(const fs::path& folder, const std::string& timesOf) {
  std::error_code status;
  if (!fs::exists(folder / "run.json", status)) return {};
  const ResultsFolder results = openResults(folder);
  std::vector<RecordedTable> tables;
  for (const PlannedBlock& planned : results.plan)
    tables.push_back(tableOf(results, planned, timesOf));
  return tables;
}

}  // namespace restlab
