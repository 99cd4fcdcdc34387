// `run --dry-run`: the matrix of jobs, and what they are going to cost.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/run/suite_runner.h"

namespace restlab {

// A table in markdown, a line a block: runs that are there, runs to be made, seconds that
// references and runs will take, memory. Seconds are those of a few frames of each method, which
// are rendered for it; nothing is written. Throws Error as runSuite() would before its first frame.
std::string planText(const std::vector<Suite>& points, const SuiteRequest& request);

}  // namespace restlab
