// Host side of the voxel cache.
#include "core/caches/voxel/voxel.h"

#include "core/caches/entries/settings.h"
#include "core/resampling/pair_settings.h"

namespace restlab {

const CacheInfo& voxelCacheInfo() {
  static const CacheInfo info = [] {
    CacheInfo i = entryCache(
        "voxel", "a hashed grid in space: a cell remembers at a surface point of its own");
    i.parameters.push_back({"voxel_pixels",
                            4.0,
                            0.25,
                            256.0,
                            {},
                            "side of a cell in pixels, rounded down to a power of two of metres",
                            "measured: docs/decisions/parameters-of-entries.md"});
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::VoxelCacheParams out{};
      out.entries = packEntries(p);
      out.grid = packGrid(p);
      out.cellPixels = static_cast<float>(std::get<double>(p.at("voxel_pixels")));
      out.similarity = packSimilarity(p);
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
