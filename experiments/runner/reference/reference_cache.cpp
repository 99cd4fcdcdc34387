// References on disk: in the results folder under a readable name, and in the user's cache under
// their key. Both are checked by key, never trusted by name.
#include <fmt/format.h>

#include <cstdlib>

#include "core/base/error.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_chunk.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

uint32_t seedOf(const Reference& reference) {
  const auto seed = reference.metadata.find("seed");
  return seed == reference.metadata.end()
             ? 0
             : uint32_t(std::strtoul(seed->second.c_str(), nullptr, 10));
}

void storeInCache(const fs::path& file, const Reference& reference) {
  if (file.empty()) return;
  try {
    makeWritableDirectory(file.parent_path());
    writeReference(file, reference);
  } catch (const Error& error) {
    logInfo(fmt::format("the reference is not cached: {}", error.what()));
  }
}

// Returns the number of samples of the stored reference; 0 if there is none of this key.
uint64_t sppIn(const fs::path& file, const std::string& key) {
  const StoredReference stored = readStored(file, key);
  return stored.reference ? stored.reference->spp : 0;
}

}  // namespace

StoredReference readStored(const fs::path& file, const std::string& key) {
  StoredReference stored;
  std::error_code status;
  if (file.empty() || !fs::exists(file, status)) return stored;
  try {
    Reference reference = readReference(file);
    const auto found = reference.metadata.find("reference_key");
    const std::string its = found == reference.metadata.end() ? "none" : found->second;
    if (its == key && reference.half0) {
      stored.reference = std::move(reference);
    } else {
      stored.unused = fmt::format("{}: is of another scene, setting or version (key {}, wanted {})",
                                  file.string(), its.substr(0, 8), key.substr(0, 8));
    }
  } catch (const Error& error) {
    stored.unused = error.what();
  }
  return stored;
}

Reference storeMerged(const PreparedScene& prepared, const ReferenceConfig& config,
                      const ReferenceState& state, const fs::path& folder,
                      const std::string& label) {
  Reference reference = referenceOf(prepared, config, state);
  makeWritableDirectory(folder);
  writeReference(folder / (safeFileName(label) + ".exr"), reference);
  ReferenceStore store;
  store.folder = referenceCacheFolder();
  if (store.folder.empty()) return reference;
  const fs::path cached = store.folder / (state.id.key + ".exr");
  if (sppIn(cached, state.id.key) < reference.spp) storeInCache(cached, reference);
  ReferenceProgress(store, state.id).save(state);
  return reference;
}

Reference obtainReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const fs::path& folder,
                          const std::string& label) {
  const std::string key = referenceKey(prepared, config);
  const fs::path local = folder / (safeFileName(label) + ".exr");
  ReferenceStore store;
  store.folder = referenceCacheFolder();
  const fs::path cached = store.folder.empty() ? fs::path() : store.folder / (key + ".exr");
  ReferenceConfig wanted = config;
  std::string unused;  // why the first file cannot be used
  for (const fs::path& file : {local, cached}) {
    StoredReference stored = readStored(file, key);
    if (stored.reference && meetsTarget(*stored.reference, target)) {
      logInfo(fmt::format("reference: {} ({} spp)", file.string(), stored.reference->spp));
      if (file != local) writeReference(local, *stored.reference);
      return std::move(*stored.reference);
    }
    if (stored.reference) {
      stored.unused =
          fmt::format("{}: has {} spp, less than wanted", file.string(), stored.reference->spp);
      const ReferenceId id{key, seedOf(*stored.reference), config.backend};
      std::error_code status;
      if (fs::exists(stateFile(store.folder, id), status)) wanted.seed = id.seed;
    }
    if (unused.empty()) unused = stored.unused;
  }
  Reference reference = renderReference(prepared, wanted, target, store, unused);
  logInfo(fmt::format("reference: {} spp in {:.1f} s, relmse {:.3g}", reference.spp,
                      reference.timeS, reference.relmse));
  writeReference(local, reference);
  storeInCache(cached, reference);
  return reference;
}

}  // namespace restlab
