// Progress of references between calls of the program: a state under the reference's key, written
// every half minute. A failed write loses progress since the last one, never the rendering.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/runner/reference/reference_state.h"

namespace restlab {

// Where and how often progress is stored.
struct ReferenceStore {
  std::filesystem::path folder;  // empty: nothing is kept
  double intervalS = 30.0;       // between two writes; longer if writing takes long
  // Beyond this size the least recently used states are removed, but none used in the last hour.
  uint64_t maxBytes = uint64_t(8) << 30;
};

// $XDG_CACHE_HOME/restlab/references or ~/.cache/restlab/references; empty where neither is set.
std::filesystem::path referenceCacheFolder();

std::filesystem::path stateFile(const std::filesystem::path& folder, const ReferenceId& id);

class ReferenceProgress {
 public:
  // Makes room in the folder. Warns if the folder cannot be written.
  ReferenceProgress(const ReferenceStore& store, ReferenceId id);

  const std::filesystem::path& file() const { return file_; }  // empty: nothing is kept
  // Returns the stored state of these samples. Logs and removes a damaged file.
  std::optional<ReferenceState> load() const;
  // Writes if the interval has passed.
  void update(const ReferenceState& state);
  // Writes at once, unless the file holds more samples already: several programs may work at one
  // reference. Warns at the first failure. Returns true if the samples are kept.
  bool save(const ReferenceState& state);

 private:
  using Clock = std::chrono::steady_clock;
  ReferenceId id_;
  std::filesystem::path file_;
  double intervalS_;
  Clock::time_point lastSave_ = Clock::now();
  double lastCostS_ = 0.0;
  bool isWarned_ = false;
};

}  // namespace restlab
