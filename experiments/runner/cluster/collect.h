// `collect`: makes a folder of results, as `run` leaves it, of what a plan's tasks have left.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/cluster/plan.h"

namespace restlab {

struct Collected {
  std::string tables;             // markdown
  std::vector<uint64_t> missing;  // tasks without a sound result
  uint64_t tasks = 0;
  uint64_t setAside = 0;  // results that were not sound, and have another name now
};

// Unpacks results into `out` (which may be the plan's folder), writes run.json and results.jsonl,
// and makes tables and report of the runs that are there. Workers may be at work meanwhile: their
// results come with the next call. Damaged results count as missing; a line names each. Throws
// Error (badInput) if `out` has results of something else, or cannot be written.
Collected collectResults(const std::filesystem::path& folder, const Plan& plan,
                         const std::filesystem::path& out);

}  // namespace restlab
