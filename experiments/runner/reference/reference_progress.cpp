#include "experiments/runner/reference/reference_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "core/base/cache_folder.h"
#include "core/base/error.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtension = ".state";
// Minimum ratio of rendering time to writing time.
constexpr double kRenderingPerSaving = 20.0;
// Files used within this time may be in use by another program.
constexpr std::chrono::hours kInUse{1};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Kept {
  fs::path file;
  fs::file_time_type used;
  uint64_t bytes = 0;
};

// Lists the states of the folder. Removes unfinished files of programs that were killed.
std::vector<Kept> statesIn(const fs::path& folder) {
  std::vector<Kept> states;
  const auto longAgo = fs::file_time_type::clock::now() - kInUse;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
    const fs::path& file = entry.path();
    Kept kept{file, entry.last_write_time(status), 0};
    if (status) continue;
    const bool isUnfinished =
        file.filename().string().find(std::string(kExtension) + ".tmp-") != std::string::npos;
    if (isUnfinished && kept.used < longAgo) fs::remove(file, status);
    if (file.extension() != kExtension) continue;
    kept.bytes = entry.file_size(status);
    if (!status) states.push_back(kept);
  }
  return states;
}

// Removes the least recently used states until the folder holds at most `maxBytes`, and logs it.
void makeRoom(const fs::path& folder, uint64_t maxBytes) {
  std::vector<Kept> states = statesIn(folder);
  uint64_t bytes = 0, removedBytes = 0;
  for (const Kept& state : states) bytes += state.bytes;
  std::sort(states.begin(), states.end(),
            [](const Kept& a, const Kept& b) { return a.used < b.used; });
  const auto longAgo = fs::file_time_type::clock::now() - kInUse;
  for (const Kept& state : states) {
    std::error_code status;
    if (bytes <= maxBytes || state.used >= longAgo) break;
    if (!fs::remove(state.file, status)) continue;
    bytes -= state.bytes;
    removedBytes += state.bytes;
  }
  if (removedBytes == 0) return;
  logInfo(
      fmt::format("{}: {} MiB of progress of references that was not used for longest is removed: "
                  "it may hold {} MiB",
                  folder.string(), removedBytes >> 20, maxBytes >> 20));
}

}  // namespace

fs::path referenceCacheFolder() { return cacheFolder("references"); }

fs::path stateFile(const fs::path& folder, const ReferenceId& id) {
  return folder / fmt::format("{}-{}-{}{}", id.key, id.backend, id.seed, kExtension);
}

ReferenceProgress::ReferenceProgress(const ReferenceStore& store, ReferenceId id)
    : id_(std::move(id)), intervalS_(store.intervalS) {
  if (store.folder.empty()) return;
  file_ = stateFile(store.folder, id_);
  try {
    makeWritableDirectory(store.folder);
    makeRoom(store.folder, store.maxBytes);
  } catch (const Error& error) {
    logWarning(fmt::format("the progress of the reference is not kept: {}", error.what()));
    isWarned_ = true;
  }
}

std::optional<ReferenceState> ReferenceProgress::load() const {
  std::error_code status;
  if (file_.empty() || !fs::exists(file_, status)) return std::nullopt;
  try {
    ReferenceState state = readReferenceState(file_);
    if (state.id != id_) {
      failInput(fmt::format("{}: is of another reference (key {})", file_.string(),
                            state.id.key.substr(0, 8)));
    }
    fs::last_write_time(file_, fs::file_time_type::clock::now(), status);
    return state;
  } catch (const Error& error) {
    logInfo(fmt::format("{}; rendered anew", error.what()));
    fs::remove(file_, status);
    return std::nullopt;
  }
}

void ReferenceProgress::update(const ReferenceState& state) {
  const double waitS = std::max(intervalS_, kRenderingPerSaving * lastCostS_);
  if (secondsSince(lastSave_) >= waitS) save(state);
}

bool ReferenceProgress::save(const ReferenceState& state) {
  if (file_.empty() || state.half1.count() == 0) return false;
  const Clock::time_point start = Clock::now();
  bool isKept = true;
  try {
    if (storedSamples(file_, id_) < state.spp()) writeReferenceState(file_, state);
  } catch (const Error& error) {
    if (!isWarned_) {
      logWarning(fmt::format("the progress of the reference is not kept: {}", error.what()));
    }
    isWarned_ = true;
    isKept = false;
  }
  lastSave_ = Clock::now();
  lastCostS_ = secondsSince(start);
  return isKept;
}

}  // namespace restlab
