// Caches of entries, in sessions of a few pixels.
#pragma once

#include "core/cache.h"
#include "core/caches/entries/settings.h"
#include "core/method.h"
#include "core/session.h"

namespace restlab::bias {

// Names of the caches that keep entries.
inline std::vector<std::string> cachesWithEntries() {
  std::vector<std::string> names;
  for (const CacheInfo* info : cacheRegistry()) {
    for (const ParameterInfo& p : info->parameters)
      if (p.name == kEntryCount) names.push_back(info->name);
  }
  return names;
}

// Entries for so few pixels: passes that go over all entries would take the most of the time.
inline void useFewEntries(SessionConfig& config) {
  for (const ParameterInfo& p : findMethod(config).parameters())
    if (p.name == kEntryCount || p.name == "radiance_entries")
      config.parameters[p.name] = int64_t{4096};
}

}  // namespace restlab::bias
