// Memory and time among the words of --sbatch.
#pragma once

#include <optional>
#include <string>

#include "experiments/runner/cluster/asked.h"

namespace restlab {

struct SbatchAsked {
  bool hasMemory = false, hasTime = false;  // the words say something about it
  // Values of `--mem` and `--time`; nothing for words that have no number to be doubled:
  // `--mem-per-cpu`, `--mem=0`, `--time=UNLIMITED`.
  std::optional<double> memoryMiB, seconds;
};

SbatchAsked askedIn(const std::string& options);

// Returns what a script is to ask for: the user's words win over the plan's, `times` as much. Zeros
// where the words are to stand as they are.
Asked withOptions(const Asked& planned, const std::string& options, double times);

}  // namespace restlab
