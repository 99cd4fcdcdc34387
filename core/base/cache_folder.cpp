#include "core/base/cache_folder.h"

#include <cstdlib>

namespace restlab {

std::filesystem::path cacheFolder(const std::string& name) {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
    return std::filesystem::path(cache) / "restlab" / name;
  if (const char* home = std::getenv("HOME"); home && *home == '/')
    return std::filesystem::path(home) / ".cache" / "restlab" / name;
  return {};
}

}  // namespace restlab
