// The pixel cache: no storage beside the pixels' own histories, which integrators keep.
#include "core/frame/cache.h"

namespace restlab {

const CacheInfo& pixelCacheInfo() {
  static const CacheInfo info = [] {
    CacheInfo i;
    i.name = "pixel";
    i.summary = "histories live in pixels alone and follow surfaces by reprojection";
    return i;
  }();
  return info;
}

}  // namespace restlab
