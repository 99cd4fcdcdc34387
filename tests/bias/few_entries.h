// Caches with entries, and meshes of elements, for sessions of a few pixels.
#pragma once

#include <algorithm>
#include <bit>

#include "core/caches/entries/settings.h"
#include "core/frame/cache.h"
#include "core/frame/method.h"
#include "core/frame/session.h"

namespace restlab::bias {

// By day this method runs with every mode, cache and end of paths. Others share its passes.
inline constexpr const char* kRunsWithAll = "restir_gi";

// Names of the caches that keep entries.
inline std::vector<std::string> cachesWithEntries() {
  std::vector<std::string> names;
  for (const CacheInfo* info : cacheRegistry()) {
    for (const ParameterInfo& p : info->parameters)
      if (p.name == kEntryCount) names.push_back(info->name);
  }
  return names;
}

// Sets about two entries per pixel of the current image size: passes over all entries would
// otherwise take most of the time.
inline void useFewEntries(SessionConfig& config) {
  const uint64_t pixels = uint64_t(config.width) * config.height;
  const uint64_t entries = std::clamp<uint64_t>(std::bit_floor(2 * pixels), 1024, 65536);
  for (const ParameterInfo& p : findMethod(config).parameters())
    if (p.name == kEntryCount || p.name == "radiance_entries")
      config.parameters[p.name] = int64_t(entries);
}

// Returns whether a method lights elements of a mesh, which reach through walls that are set on
// them.
inline bool hasElements(const SessionConfig& config) {
  const std::vector<ParameterInfo> all = findMethod(config).parameters();
  return std::any_of(all.begin(), all.end(),
                     [](const ParameterInfo& p) { return p.name == "element_size"; });
}

// Sets so few elements, with so few rays, that solving takes no time.
inline void useFewElements(SessionConfig& config) {
  if (!hasElements(config)) return;
  config.parameters["elements"] = int64_t{128};
  config.parameters["factor_rays"] = int64_t{64};
  config.parameters["light_samples"] = int64_t{16};
}

}  // namespace restlab::bias
