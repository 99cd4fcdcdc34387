// `run --dry-run`: lists the jobs of a suite and estimates their cost.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/results/suite_runner.h"

namespace restlab {

// Returns a markdown table with one line per block: existing runs, missing runs, estimated seconds
// of references and runs, memory. Seconds are measured by rendering a few frames of each method;
// nothing is written. Throws Error as runSuite() would before its first frame.
std::string planText(const std::vector<Suite>& points, const SuiteRequest& request);

}  // namespace restlab
