// `plan`: cuts a suite into tasks.
#pragma once

#include "experiments/runner/cluster/plan.h"

namespace restlab {

struct PlanRequest {
  std::filesystem::path out;
  std::vector<std::string> argv;
  uint32_t runsOfTask = 1;  // runs of a table in one task
  uint64_t sppOfChunk = 0;  // samples per pixel of a chunk; 0: at most kMostChunks chunks
  bool measures = true;     // estimate time and memory by rendering some frames
};

// Chunks of a reference where nothing else is asked for: a chunk's file is as large as an image,
// and whoever merges reads all of them.
constexpr uint64_t kMostChunks = 64;

// Checks the suite like `run`, and plans what is to be rendered. Nothing is written. References
// that the folder or the user's cache has are no tasks. Throws Error as runSuite() would before its
// first frame.
Plan makePlan(const std::vector<Suite>& points, const PlanRequest& request);

// Writes plan.json and suite.toml, makes the folders of results, and copies references from the
// user's cache. A folder that has the same plan keeps it, and what was done. Throws Error
// (badInput) if the folder has another plan.
void savePlan(const std::vector<Suite>& points, const PlanRequest& request, const Plan& plan);

// Returns a markdown table: tasks, time and memory of each group, and their sum in node hours.
std::string planTable(const Plan& plan);

}  // namespace restlab
