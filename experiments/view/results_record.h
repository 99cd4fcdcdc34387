// Order and times of the methods in a folder of results, as `run` has noted them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace restlab {

struct RecordedTable {
  std::string label;                 // as in the names of files: "cornell-box-all"
  std::vector<std::string> methods;  // in the suite's order
  // Median milliseconds of the timed frames of all runs; without those that were not measured.
  std::map<std::string, double> msOf;
};

// Returns the tables in the order of the plan; nothing if the folder has no record. `timesOf`:
// label of the only table whose times are read. Throws std::exception if the record cannot be read.
std::vector<RecordedTable> recordedTables(const std::filesystem::path& folder,
                                          const std::string& timesOf = "");

}  // namespace restlab
