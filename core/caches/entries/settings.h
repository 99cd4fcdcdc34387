// Host side of entries: what caches in world space share.
#pragma once

#include <string>
#include <vector>

#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"
#include "core/frame/cache.h"

namespace restlab {

// Parameter with the number of entries. The cache of a method without it has no entries.
constexpr const char* kEntryCount = "entries";
// Buffer of each pixel's entry; a value that is no hash slot means none.
constexpr const char* kEntryOfPixel = "entry_of_pixel";

// Describes a cache of entries that a hash grid finds: parameters (the cache appends its own) and
// layers. Its passes: core/caches/entries/passes.h.
CacheInfo entryCache(const std::string& name, const std::string& summary);

// Pack the parameters of entries. All zero if the method's cache has no entries.
rl::EntryParams packEntries(const ParameterMap& parameters);
rl::GridParams packGrid(const ParameterMap& parameters);

}  // namespace restlab
