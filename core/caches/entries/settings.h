// Host side of entries: what caches in world space share.
#pragma once

#include <string>
#include <vector>

#include "core/cache.h"
#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"

namespace restlab {

// The parameter that says how many entries there are. A method without it has a cache without any.
constexpr const char* kEntryCount = "entries";
// The buffer of each pixel's entry; what is no place in the grid stands for none.
constexpr const char* kEntryOfPixel = "entry_of_pixel";

// A cache of entries that a grid finds: its inputs, its buffers but for those of its own, which
// come last, its parameters but for those of its own, its layers, and its passes: kernels
// <name>_clear, _find, _claim, _settle, _propose, _feeders (core/caches/entries/*.glsl).
CacheInfo entryCache(const std::string& name, const std::string& summary);
// A buffer of one for each entry.
BufferInfo entryBuffer(const std::string& name, uint32_t entryBytes);

// All zero where the method's cache has no entries.
rl::EntryParams packEntries(const ParameterMap& parameters);
rl::GridParams packGrid(const ParameterMap& parameters);

}  // namespace restlab
