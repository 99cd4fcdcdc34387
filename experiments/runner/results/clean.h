// Removes files that a folder of results no longer needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite.h"

namespace restlab {

// Returns whether the suite itself reads this file.
bool readsFile(const Suite& suite, const std::filesystem::path& file);

// Numbers of removed and kept files.
struct Cleaned {
  size_t jobs = 0, jobsKept = 0;
  std::vector<std::string> references;  // names of removed files
  size_t referencesKept = 0;
  size_t unfinished = 0;    // files and folders left by interrupted writers
  uint64_t bytes = 0;       // of everything removed
  bool isFinished = false;  // false: the last suite may need more than is known, so only unfinished
                            // files were removed
};

// Removes jobs and references that the folder's last suite does not use. Throws Error (badInput) if
// the folder was not written by `run`, or if another program is at work there.
Cleaned cleanResults(const std::filesystem::path& folder);

}  // namespace restlab
