// Folder written by `run`: reads its contents and makes its tables again without rendering.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// A block of the plan in run.json.
struct PlannedBlock {
  std::string point, scene, camera, component, reference;
  uint32_t width = 0, height = 0;
  std::vector<std::string> jobs;    // keys, in the order of their runs
  std::vector<std::string> images;  // keys of the rows of images
  std::vector<std::string> warnings;
};

struct ResultsFolder {
  std::filesystem::path folder;
  nlohmann::ordered_json record;  // run.json
  std::vector<Suite> points;      // of suite.toml
  // By point and scene: the suite with a scene's own settings applied.
  std::map<std::pair<std::string, std::string>, Suite> ofScenes;
  std::vector<PlannedBlock> plan;
};

// Reads run.json and suite.toml. Throws Error (badInput) naming the file if the folder was not
// written by `run`.
ResultsFolder openResults(const std::filesystem::path& folder);

// Returns the suite of a block's point and scene. Throws Error (badInput) if suite.toml lacks it.
const Suite& suiteOf(const ResultsFolder& results, const PlannedBlock& block);

// Loads the block with all jobs of the plan. Logs missing or damaged jobs.
struct LoadedBlock {
  BlockResult result;
  std::vector<std::string> missing;  // keys
};
LoadedBlock loadBlock(const ResultsFolder& results, const PlannedBlock& block);

struct RemadeOutputs {
  std::string tables;                // markdown
  std::vector<std::string> missing;  // keys of jobs that are absent or damaged
};
// Writes all outputs of `run` again, except jobs, references and results.jsonl. Throws Error.
RemadeOutputs remakeOutputs(const std::filesystem::path& folder);

}  // namespace restlab
