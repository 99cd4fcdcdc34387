// Inputs that the numbers of a folder of results depend on, as words, and differences between
// folders.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/runner/results/results_folder.h"

namespace restlab {

using Words = std::map<std::string, std::string>;

// Origin of a folder's numbers: commit, sources, compiler, machine, devices. A word holds several
// values, joined, if the folder has runs of several builds.
struct FolderOrigin {
  std::string folder, status;
  Words words;
};
FolderOrigin originOf(const ResultsFolder& results);
// Returns "a: finished, commit 0123456789ab, ...".
std::string originText(const FolderOrigin& origin);
// Returns "git_commit a / b" for each differing word.
std::vector<std::string> originDifferences(const FolderOrigin& before, const FolderOrigin& after);

// Returns, by method name, what the numbers of a block depend on, without what FolderOrigin has.
std::map<std::string, Words> blockWords(const ResultsFolder& results, const PlannedBlock& block,
                                        const Reference& reference);

struct Difference {
  std::string text;        // "max_bounces 8 / 2"
  bool isSetting = false;  // defines the measured quantity: unlike things are compared
};
std::vector<Difference> differencesOf(const Words& before, const Words& after);

}  // namespace restlab
