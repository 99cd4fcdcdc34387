// results.jsonl: one JSON object per line, append-only.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "experiments/runner/run/experiment.h"

namespace restlab {

class ResultsLog {
 public:
  // Notes which jobs have lines in the file. Cuts off incomplete jobs at the end, left by a killed
  // writer, and logs that. Throws Error (badInput) with file and line if a line is no JSON object.
  explicit ResultsLog(std::filesystem::path file);

  // Appends the job's lines unless they exist. Lines of a job that was rendered again are always
  // appended, with `replaces_earlier`. Writes all of them or none: throws Error (badInput) if the
  // disk is full or read-only, and restores the file.
  void add(const std::string& key, const JobData& job, bool isMadeAnew = false);

 private:
  std::filesystem::path file_;
  std::set<std::string> jobs_;
};

}  // namespace restlab
