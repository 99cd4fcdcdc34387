// `run`: a suite from its file to its folder of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite.h"

namespace restlab {

struct SuiteRequest {
  std::filesystem::path out;
  std::vector<std::string> argv;  // recorded in run.json
  bool force = false;             // jobs that are there are made anew
};

// Executes every block of every point; prints each table on stdout as soon as it is known. Runs
// that are in the folder already, under their key, are taken as they are. Returns false when it was
// interrupted: what was finished is written. Throws Error; where another program is at work in the
// folder, badInput.
bool runSuite(const std::vector<Suite>& points, const SuiteRequest& request);

}  // namespace restlab
