#include "experiments/runner/results/results_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/results/folder_lock.h"
#include "experiments/runner/results/outputs.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/run/run_record.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

PlannedBlock blockOf(const Json& json) {
  PlannedBlock block;
  block.point = json.at("point").get<std::string>();
  block.scene = json.at("scene").get<std::string>();
  block.camera = json.at("camera").get<std::string>();
  block.component = json.at("component").get<std::string>();
  block.reference = json.at("reference").get<std::string>();
  block.width = json.at("width").get<uint32_t>();
  block.height = json.at("height").get<uint32_t>();
  block.jobs = json.at("jobs").get<std::vector<std::string>>();
  for (auto [key, list] : {std::pair{"images", &block.images}, {"warnings", &block.warnings}})
    if (json.contains(key)) *list = json.at(key).get<std::vector<std::string>>();
  return block;
}

}  // namespace

ResultsFolder openResults(const fs::path& folder) {
  ResultsFolder results;
  results.folder = folder;
  const fs::path file = folder / "run.json";
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    std::error_code status;
    const bool isAbsent = !fs::exists(file, status) && !isHidden(status);
    failInput(fmt::format(
        "{}: {}{}", file.string(), unreadableReason(file),
        isAbsent ? fmt::format("; {} is no folder that `restlab run` left", folder.string()) : ""));
  }
  std::vector<std::string> methods;
  try {
    results.record = Json::parse(in);
    if (results.record.at("schema").get<int>() != kResultsSchema) {
      failInput(fmt::format("has schema {}, this program reads {}",
                            results.record.at("schema").dump(), kResultsSchema));
    }
    methods = results.record.at("methods").get<std::vector<std::string>>();
    for (const Json& block : results.record.at("plan")) results.plan.push_back(blockOf(block));
  } catch (const std::exception& error) {
    failInput(fmt::format("{}: {}", file.string(), error.what()));
  }
  results.points = loadSuites(folder / "suite.toml", {}, {});
  for (Suite& suite : results.points) {
    std::erase_if(suite.methods, [&](const SuiteMethod& method) {
      return std::find(methods.begin(), methods.end(), method.name) == methods.end();
    });
    for (const SuiteScene& scene : suite.scenes) {
      if (scene.hasOwnSettings())
        results.ofScenes.emplace(std::pair(suite.point, scene.name), ofScene(suite, scene));
    }
  }
  return results;
}

const Suite& suiteOf(const ResultsFolder& results, const PlannedBlock& block) {
  const auto own = results.ofScenes.find({block.point, block.scene});
  if (own != results.ofScenes.end()) return own->second;
  for (const Suite& suite : results.points) {
    if (suite.point == block.point) return suite;
  }
  failInput(fmt::format("{}: has no point '{}' of run.json's plan",
                        (results.folder / "suite.toml").string(), block.point));
}

LoadedBlock loadBlock(const ResultsFolder& results, const PlannedBlock& planned) {
  const JobStore store(results.folder);
  const Suite& suite = suiteOf(results, planned);
  LoadedBlock loaded;
  BlockResult& block = loaded.result;
  block.scene = planned.scene;
  block.camera = planned.camera;
  block.component = parseComponent(planned.component, "run.json");
  block.width = planned.width;
  block.height = planned.height;
  block.referenceFile = planned.reference;
  block.reference = readReference(results.folder / planned.reference);
  for (const auto* keys : {&planned.jobs, &planned.images}) {
    for (const std::string& key : *keys) {
      const std::optional<JobData> job = store.load(key);
      if (job) {
        addJob(suite, *job, block);
        continue;
      }
      loaded.missing.push_back(key);
      logWarning(fmt::format("{}: is missing or damaged; left out", store.folderOf(key).string()));
    }
  }
  compareMachines(block);
  return loaded;
}

RemadeOutputs remakeOutputs(const fs::path& folder) {
  const ResultsFolder results = openResults(folder);
  const FolderLock lock(folder);
  Outputs outputs(folder);
  std::vector<DeviceUse> devices;
  for (const Json& use : results.record.at("devices")) {
    devices.push_back({use.at("backend").get<std::string>(), use.at("device").get<std::string>(),
                       use.at("ray_tracing").get<std::string>()});
  }
  outputs.use(devices);
  for (const Json& line : results.record.at("skipped")) outputs.note(line.get<std::string>());
  RemadeOutputs made;
  const bool finished = results.record.at("status").get<std::string>() == "finished";
  for (const PlannedBlock& planned : results.plan) {
    if (planned.jobs.empty() && planned.images.empty()) continue;
    for (const std::string& line : planned.warnings) outputs.note("Warning: " + line);
    LoadedBlock block = loadBlock(results, planned);
    made.missing.insert(made.missing.end(), block.missing.begin(), block.missing.end());
    if (!block.result.methods.empty())
      made.tables += outputs.add(suiteOf(results, planned), std::move(block.result));
  }
  outputs.write(results.points.front(), results.record, finished && made.missing.empty());
  outputs.writePages(results.points.front(), results.record);
  return made;
}

}  // namespace restlab
