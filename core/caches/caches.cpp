#include "core/caches/caches.h"

#include "core/error.h"

namespace restlab {

const std::vector<CacheInfo>& cacheRegistry() {
  static const std::vector<CacheInfo> caches = {
      {"pixel",
       "one slot a pixel; donors by reprojection over time and from a mirror partner over space"},
  };
  return caches;
}

void checkCacheName(const std::string& name) {
  std::vector<std::string> names;
  for (const CacheInfo& c : cacheRegistry()) names.push_back(c.name);
  for (const std::string& n : names) {
    if (n == name) return;
  }
  failUsage("unknown cache '" + name + "'" + didYouMean(name, names) +
            " (see: restlab list caches)");
}

}  // namespace restlab
