// Registry of the caches that reservoirs live in. A cache answers five questions (cache.glsl).
#pragma once

#include <string>
#include <vector>

namespace restlab {

struct CacheInfo {
  std::string name;
  std::string summary;
};

const std::vector<CacheInfo>& cacheRegistry();
// Throws Error (badUsage) with the nearest name.
void checkCacheName(const std::string& name);

}  // namespace restlab
