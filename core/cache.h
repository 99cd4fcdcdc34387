// Where the past of a surface lies. A cache is a folder under core/caches/, a line in
// core/caches/caches.list, and in the folder kernels of its passes and one .cpp that defines `const
// CacheInfo& <name>CacheInfo()`. Integrators name none: they read the buffers that every cache has
// (core/caches/README.md).
#pragma once

#include <string>
#include <vector>

#include "core/part.h"

namespace restlab {

// Its passes run before the integrator's.
struct CacheInfo : PartInfo {};

// All caches of caches.list, in its order; the first is the default.
const std::vector<const CacheInfo*>& cacheRegistry();
// Throws Error (badUsage) with the nearest name.
const CacheInfo& findCache(const std::string& name);

}  // namespace restlab
