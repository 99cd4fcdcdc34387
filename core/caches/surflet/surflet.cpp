// Host side of the surflet cache.
#include "core/caches/surflet/surflet.h"

#include "core/caches/entries/settings.h"
#include "core/resampling/pair_settings.h"

namespace restlab {

const CacheInfo& surfletCacheInfo() {
  static const CacheInfo info = [] {
    CacheInfo i =
        entryCache("surflet", "discs on surfaces: each remembers at a surface point of its own");
    // One per entry; comes after the buffers that all caches with entries have.
    i.buffers.push_back(entryBuffer("discs", 16 * rl::RL_SHADING_POINT_QUADS));
    i.parameters.push_back({"surflet_pixels",
                            6.0,
                            0.25,
                            256.0,
                            {},
                            "radius of a disc in pixels, where it is spawned",
                            "measured: docs/decisions/parameters-of-entries.md"});
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::SurfletCacheParams out{};
      out.entries = packEntries(p);
      out.grid = packGrid(p);
      out.discPixels = static_cast<float>(std::get<double>(p.at("surflet_pixels")));
      out.similarity = packSimilarity(p);
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
