// What the numbers of a folder of results depend on, in words, and in which of them two folders
// differ.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/runner/run/results_folder.h"

namespace restlab {

using Words = std::map<std::string, std::string>;

// Who made a folder's numbers: commit, sources, compiler, machine, devices. A word has several
// values, joined, where runs of several builds are in the folder.
struct FolderOrigin {
  std::string folder, status;
  Words words;
};
FolderOrigin originOf(const ResultsFolder& results);
// "a: finished, commit 0123456789ab, ...".
std::string originText(const FolderOrigin& origin);
// "git_commit a / b" for each word in which they differ.
std::vector<std::string> originDifferences(const FolderOrigin& before, const FolderOrigin& after);

// What the numbers of each method of a block depend on but for what FolderOrigin has, by the
// method's name.
std::map<std::string, Words> blockWords(const ResultsFolder& results, const PlannedBlock& block,
                                        const Reference& reference);

struct Difference {
  std::string text;        // "max_bounces 8 / 2"
  bool isSetting = false;  // of what defines the measured quantity: the two are unlike things
};
std::vector<Difference> differencesOf(const Words& before, const Words& after);

}  // namespace restlab
