// Caches of entries in sessions of a few pixels.
#pragma once

#include "core/caches/entries/settings.h"
#include "core/method.h"
#include "core/session.h"

namespace restlab::bias {

// Entries for so few pixels: passes that go over all entries would take the most of the time.
inline void useFewEntries(SessionConfig& config) {
  for (const ParameterInfo& p : findMethod(config).parameters())
    if (p.name == kEntryCount || p.name == "radiance_entries")
      config.parameters[p.name] = int64_t{4096};
}

}  // namespace restlab::bias
