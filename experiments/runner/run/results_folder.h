// A folder that `run` left: what it holds, and its tables made again without rendering.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/summary/summary.h"

namespace restlab {

// A block of the plan in run.json.
struct PlannedBlock {
  std::string point, scene, camera, component, reference;
  uint32_t width = 0, height = 0;
  std::vector<std::string> jobs;    // keys, in the order of their runs
  std::vector<std::string> images;  // the same of the rows of images
};

struct ResultsFolder {
  std::filesystem::path folder;
  nlohmann::ordered_json record;  // run.json
  std::vector<Suite> points;      // of suite.toml
  // By point and scene: as it is for a scene that has settings of its own.
  std::map<std::pair<std::string, std::string>, Suite> ofScenes;
  std::vector<PlannedBlock> plan;
};

// Reads run.json and suite.toml. Throws Error (badInput) naming the file where the folder is not
// one that `run` left.
ResultsFolder openResults(const std::filesystem::path& folder);

// The suite of a block's point and scene; throws Error (badInput) where suite.toml has none.
const Suite& suiteOf(const ResultsFolder& results, const PlannedBlock& block);

// The block with every job of the plan that is there. A job that is missing or damaged is one line
// and counted.
struct LoadedBlock {
  BlockResult result;
  size_t missing = 0;
};
LoadedBlock loadBlock(const ResultsFolder& results, const PlannedBlock& block);

// Everything that `run` writes besides jobs, references and results.jsonl, made again; the tables
// are returned. Throws Error.
std::string remakeOutputs(const std::filesystem::path& folder);

}  // namespace restlab
