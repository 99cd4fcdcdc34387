// References on disk: in the result folder under a readable name, and in the user's cache under
// their key. Both are checked by key; neither is trusted by name.
#include <fmt/format.h>

#include <cstdlib>

#include "core/error.h"
#include "experiments/runner/files.h"
#include "experiments/runner/log.h"
#include "experiments/runner/reference.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

// The stored reference where it can serve; otherwise one line says why it cannot.
std::optional<Reference> tryStored(const fs::path& file, const std::string& key,
                                   const ReferenceTarget& target) {
  std::error_code status;
  if (file.empty() || !fs::exists(file, status)) return std::nullopt;
  Reference reference;
  try {
    reference = readReference(file);
  } catch (const Error& error) {
    logInfo(fmt::format("{}; rendered anew", error.what()));
    return std::nullopt;
  }
  const auto stored = reference.metadata.find("reference_key");
  if (stored == reference.metadata.end() || stored->second != key || !reference.half0) {
    logInfo(fmt::format(
        "{}: is of another scene, setting or version (key {}, wanted {}); "
        "rendered anew",
        file.string(), stored == reference.metadata.end() ? "none" : stored->second.substr(0, 8),
        key.substr(0, 8)));
    return std::nullopt;
  }
  if (!meetsTarget(reference, target)) {
    logInfo(fmt::format("{}: has {} spp, less than wanted; rendered anew", file.string(),
                        reference.spp));
    return std::nullopt;
  }
  return reference;
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

}  // namespace

fs::path referenceCacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/') {
    return fs::path(cache) / "restlab" / "references";
  }
  if (const char* home = std::getenv("HOME"); home && *home == '/') {
    return fs::path(home) / ".cache" / "restlab" / "references";
  }
  return {};
}

Reference obtainReference(const PreparedScene& prepared, const ReferenceConfig& config,
                          const ReferenceTarget& target, const fs::path& folder,
                          const std::string& label) {
  const std::string key = referenceKey(prepared, config);
  const fs::path local = folder / (safeFileName(label) + ".exr");
  const fs::path cacheFolder = referenceCacheFolder();
  const fs::path cached = cacheFolder.empty() ? fs::path() : cacheFolder / (key + ".exr");
  if (std::optional<Reference> found = tryStored(local, key, target)) {
    logInfo(fmt::format("reference: {} ({} spp)", local.string(), found->spp));
    return std::move(*found);
  }
  if (std::optional<Reference> found = tryStored(cached, key, target)) {
    logInfo(fmt::format("reference: {} ({} spp)", cached.string(), found->spp));
    writeReference(local, *found);
    return std::move(*found);
  }
  Reference reference = renderReference(prepared, config, target);
  logInfo(fmt::format("reference: {} spp in {:.1f} s, relmse {:.3g}", reference.spp,
                      reference.timeS, reference.relmse));
  writeReference(local, reference);
  storeInCache(cached, reference);
  return reference;
}

}  // namespace restlab
