// Storage of the history of surfaces. A cache is a folder under core/caches/, a line in
// core/caches/caches.list, and in the folder kernels of its passes and one .cpp that defines `const
// CacheInfo& <name>CacheInfo()`. Integrators name no cache: they read the buffers that every cache
// has (core/caches/README.md).
#pragma once

#include <string>
#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Passes of the cache run before those of the integrator.
struct CacheInfo : PartInfo {};

// All caches of caches.list, in its order; the first is the default.
const std::vector<const CacheInfo*>& cacheRegistry();
// Throws Error (badUsage) with the nearest name if the cache is unknown.
const CacheInfo& findCache(const std::string& name);

}  // namespace restlab
