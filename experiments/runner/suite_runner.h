// `run`: a suite from its file to its folder of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite.h"

namespace restlab {

struct SuiteRequest {
  std::filesystem::path out;
  std::vector<std::string> argv;  // recorded in run.json
};

// Executes every block; prints each table on stdout as soon as it is known. Returns false when it
// was interrupted: what was finished is written. Throws Error.
bool runSuite(const Suite& suite, const SuiteRequest& request);

}  // namespace restlab
