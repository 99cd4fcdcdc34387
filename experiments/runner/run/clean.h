// What a folder of results no longer needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite.h"

namespace restlab {

// True where the suite itself reads this file.
bool readsFile(const Suite& suite, const std::filesystem::path& file);

// What was removed of DIR, and what stayed.
struct Cleaned {
  size_t jobs = 0, jobsKept = 0;
  std::vector<std::string> references;  // names of their files
  size_t referencesKept = 0;
  size_t unfinished = 0;    // files and folders that interrupted writers left
  uint64_t bytes = 0;       // of all that was removed
  bool isFinished = false;  // false: the last suite may need more than is known, so that only the
                            // unfinished were removed
};

// Removes jobs and references that the folder's last suite does not use. Throws Error (badInput)
// where the folder is none that `run` left, or another program is at work there.
Cleaned cleanResults(const std::filesystem::path& folder);

}  // namespace restlab
