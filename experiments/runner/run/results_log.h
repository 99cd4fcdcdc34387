// results.jsonl: one JSON object a line, append-only.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "experiments/runner/run/experiment.h"

namespace restlab {

class ResultsLog {
 public:
  // Notes which jobs the file has lines of. A last line without an end, which a killed writer left,
  // is cut off, with one line that says so; of a line that is no JSON object throws Error
  // (badInput) with file and line.
  explicit ResultsLog(std::filesystem::path file);

  // Adds the job's lines unless they are there; lines of a job that was made anew are added in any
  // case, with `replaces_earlier`. All of them or none: throws Error (badInput) where the disk is
  // full or read-only, with the file as it was.
  void add(const std::string& key, const JobData& job, bool isMadeAnew = false);

 private:
  std::filesystem::path file_;
  std::set<std::string> jobs_;
};

}  // namespace restlab
