// restlab status, report, clean: work on folders written by `run`.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "experiments/cli/verbs.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/cluster/plan_status.h"
#include "experiments/runner/results/clean.h"
#include "experiments/runner/results/results_folder.h"
#include "experiments/runner/run/job.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct FolderOptions {
  std::string folder;
  bool json = false;
};

// Counts the existing jobs of a block.
size_t countThere(const PlannedBlock& block, const std::vector<std::string>& there) {
  return size_t(std::count_if(block.jobs.begin(), block.jobs.end(), [&](const std::string& key) {
    return std::binary_search(there.begin(), there.end(), key);
  }));
}

void showStatus(const FolderOptions& options) {
  if (isPlanFolder(options.folder)) {
    const Json status = planStatus(options.folder, readPlan(options.folder));
    if (options.json)
      printJsonText(status.dump(2));
    else
      printText(planStatusText(status));
    return;
  }
  const ResultsFolder results = openResults(options.folder);
  const std::vector<std::string> there = JobStore(options.folder).keys();
  Json blocks = Json::array();
  for (const PlannedBlock& block : results.plan) {
    const Suite& suite = suiteOf(results, block);
    blocks.push_back({{"scene", block.scene},
                      {"component", block.component},
                      {"point", block.point},
                      {"runs_wanted", suite.runs},
                      {"runs_there", countThere(block, there)}});
  }
  if (options.json) {
    printJsonText(Json({{"folder", options.folder},
                        {"suite", results.record.at("suite")},
                        {"status", results.record.at("status")},
                        {"started", results.record.at("started")},
                        {"written", results.record.at("written")},
                        {"blocks", blocks}})
                      .dump(2));
    return;
  }
  print("{}: {}, {} (written {})\n", options.folder, results.record.at("suite").get<std::string>(),
        results.record.at("status").get<std::string>(),
        results.record.at("written").get<std::string>());
  for (const Json& block : blocks) {
    const std::string point = block["point"].get<std::string>();
    print("  {} ({}){}: {} of {} runs\n", block["scene"].get<std::string>(),
          block["component"].get<std::string>(), point.empty() ? "" : ", " + point,
          block["runs_there"].dump(), block["runs_wanted"].dump());
  }
}

void cleanFolder(const FolderOptions& options) {
  const Cleaned cleaned = cleanResults(options.folder);
  if (!cleaned.isFinished) {
    logInfo(
        fmt::format("{}: its last run is not finished, and may need any of its jobs and "
                    "references; only what was half made is removed",
                    options.folder));
  }
  logInfo(fmt::format(
      "{}: removed {} folders of jobs, {} references{}{} and {} half-made files or folders: "
      "{:.1f} MiB; kept {} jobs and {} references",
      options.folder, cleaned.jobs, cleaned.references.size(),
      cleaned.references.empty() ? "" : ": ", fmt::join(cleaned.references, ", "),
      cleaned.unfinished, double(cleaned.bytes) / (1024.0 * 1024.0), cleaned.jobsKept,
      cleaned.referencesKept));
}

CLI::App* addFolderVerb(CLI::App& app, const char* name, const char* help,
                        const std::shared_ptr<FolderOptions>& options) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("folder", options->folder, "a folder that `run` left")->required();
  return verb;
}

}  // namespace

Action addStatusVerb(CLI::App& app) {
  auto options = std::make_shared<FolderOptions>();
  CLI::App* verb =
      addFolderVerb(app, "status", "what a folder of results has and what is missing", options);
  verb->add_flag("--json", options->json, "as JSON");
  return [options](Outcome&) { showStatus(*options); };
}

Action addReportVerb(CLI::App& app) {
  auto options = std::make_shared<FolderOptions>();
  addFolderVerb(app, "report", "makes tables, plots and report again from finished runs", options);
  return [options](Outcome&) {
    printText(remakeOutputs(options->folder).tables);
    logInfo(fmt::format("{}: written", options->folder));
  };
}

Action addCleanVerb(CLI::App& app) {
  auto options = std::make_shared<FolderOptions>();
  addFolderVerb(app, "clean",
                "removes runs and references that the folder's last suite does not use", options);
  return [options](Outcome&) { cleanFolder(*options); };
}

}  // namespace restlab
