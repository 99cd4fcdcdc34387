// How far a plan is: which tasks are done, at work, or ended without a result.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "experiments/runner/cluster/mark.h"
#include "experiments/runner/cluster/plan.h"

namespace restlab {

struct TasksThere {
  std::vector<bool> isDone;        // by index
  std::map<uint64_t, Mark> marks;  // of tasks that are not done
  uint64_t done() const;
  std::vector<uint64_t> missing() const;
};

// Reads names of files alone, and the marks of tasks that are not done.
TasksThere tasksThere(const std::filesystem::path& folder, const Plan& plan);

// Removes what killed workers have left beside the results of tasks that are done and at which
// nobody is at work: files FILE.tmp-...
void removeLeftovers(const std::filesystem::path& folder, const Plan& plan,
                     const TasksThere& there);

// Returns "0-3,7" for sorted numbers.
std::string rangesText(const std::vector<uint64_t>& numbers);

}  // namespace restlab
