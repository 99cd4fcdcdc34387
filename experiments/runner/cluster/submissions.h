// Record of the tasks that engines were given (submissions.json in the folder of a plan).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/cluster/mark.h"

namespace restlab {

struct Submission {
  std::string id;               // of the scheduler; "" of processes here
  std::vector<uint64_t> tasks;  // sorted; empty: the job that goes on with the plan
  Asked asked;                  // zeros: nothing was asked for
  uint64_t round = 0;           // of calls by hand
  std::string written;
};

struct Submissions {
  std::string engine, options;  // options: of --sbatch
  std::vector<Submission> all;
  uint64_t collected = 0;  // the last round at whose end results were collected

  uint64_t round() const { return all.empty() ? 0 : all.back().round; }
  // Returns how often the task was handed over in the last round, and what it asked for last.
  int attempts(uint64_t task) const;
  const Submission* last(uint64_t task) const;
  // Returns whether a mark of the task was made by an attempt of the last round, not before.
  bool isOfRound(const Mark& mark, uint64_t task) const;
};

// Returns nothing handed over if there is no file. Throws Error (badInput) naming a damaged file.
Submissions readSubmissions(const std::filesystem::path& folder);
void writeSubmissions(const std::filesystem::path& folder, const Submissions& submissions);

}  // namespace restlab
