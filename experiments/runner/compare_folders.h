// Is this version better? Two folders of results, table by table, method by method.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/results_folder.h"

namespace restlab {

struct ComparedRow {
  std::string table, method;
  Interval before, after;  // MSE
  // mse(before) / mse(after), runs paired where both folders have the same seeds; and
  // time(after) / time(before), each over that of its own `path` where both tables have one, as the
  // clocks of two hours differ.
  Interval mseRatio, timeRatio;
  bool timesOverPath = false;
  // "better", "worse": the interval of the ratio leaves out 1; "not told apart" otherwise.
  std::string errorVerdict, timeVerdict;
};

struct FolderComparison {
  std::vector<ComparedRow> rows;
  std::vector<std::string> notes;  // what is in one folder only, other references, other settings
};

// Throws Error (badInput) where a folder is none that `run` left, or the two have no method of a
// table in common.
FolderComparison compareFolders(const std::filesystem::path& before,
                                const std::filesystem::path& after);

// As a table in markdown, with the notes.
std::string comparisonTable(const FolderComparison& comparison);
nlohmann::ordered_json comparisonJson(const FolderComparison& comparison);

}  // namespace restlab
