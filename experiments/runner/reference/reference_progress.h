// Progress of references between calls of the program: a state under the reference's key, written
// every half a minute. A file that cannot be written costs what was rendered since, never the
// rendering.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "experiments/runner/reference/reference_state.h"

namespace restlab {

// Where progress is kept, and how.
struct ReferenceStore {
  std::filesystem::path folder;  // empty: nothing is kept
  double intervalS = 30.0;       // between two writes; more where writing takes long
  // States that were not used for longest are removed beyond this; never one of the last hour.
  uint64_t maxBytes = uint64_t(8) << 30;
};

// $XDG_CACHE_HOME/restlab/references or ~/.cache/restlab/references; empty where neither is set.
std::filesystem::path referenceCacheFolder();

// The file of a state in its folder.
std::filesystem::path stateFile(const std::filesystem::path& folder, const ReferenceId& id);

class ReferenceProgress {
 public:
  // Makes room in the folder. One that cannot be written to is a warning.
  ReferenceProgress(const ReferenceStore& store, ReferenceId id);

  const std::filesystem::path& file() const { return file_; }  // empty: nothing is kept
  // What was kept of these samples. A damaged file is one line, and is removed.
  std::optional<ReferenceState> load() const;
  // Writes when it is time to.
  void update(const ReferenceState& state);
  // Writes at once, unless the file holds more already: programs may work at one reference at the
  // same time. The first failure is a warning. True when the samples are kept.
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
