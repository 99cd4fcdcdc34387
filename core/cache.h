// Where reservoirs live. A cache is a folder under core/caches/, a line in core/caches/caches.list,
// and in the folder <name>.h, <name>.glsl (core/caches/README.md says what they answer), kernels of
// its own passes, and one .cpp that defines `const CacheInfo& <name>CacheInfo()`. Integrators name
// none: their kernels are compiled once for each (EVERY_CACHE in rl_add_kernel).
#pragma once

#include <string>
#include <vector>

#include "core/part.h"

namespace restlab {

// Its passes run before the integrator's. Its buffers, inputs first, are the RL_CACHE_BUFFERS of
// <name>.h, its parameters RL_CACHE_PARAMS: kernels read them as gCache and gCacheParams.
struct CacheInfo : PartInfo {};

// All caches of caches.list, in its order; the first is the default.
const std::vector<const CacheInfo*>& cacheRegistry();
// Throws Error (badUsage) with the nearest name.
const CacheInfo& findCache(const std::string& name);

}  // namespace restlab
