// `run`: executes a suite and writes its folder of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite.h"

namespace restlab {

struct SuiteRequest {
  std::filesystem::path out;
  std::vector<std::string> argv;  // recorded in run.json
  bool force = false;             // existing jobs are rendered again
};

// Executes every block of every point and prints each table on stdout as soon as it is complete.
// Runs that exist in the folder under their key are reused. Returns false after an interrupt, with
// all finished results written. Throws Error; badInput if another program is at work in the folder.
bool runSuite(const std::vector<Suite>& points, const SuiteRequest& request);

}  // namespace restlab
