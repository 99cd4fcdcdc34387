// Host side of the voxel cache.
#include "core/caches/voxel/voxel.h"

#include "core/caches/entries/passes.h"
#include "core/caches/entries/settings.h"
#include "core/resampling/pair_settings.h"

namespace restlab {

namespace {

void recordVoxel(FrameGraph& g, const FrameInfo& f) {
  rl::VoxelCacheParams params{};
  params.entries = packEntries(f.parameters);
  params.grid = packGrid(f.parameters);
  params.cellPixels = floatOf(f.parameters, "voxel_pixels");
  params.similarity = packSimilarity(f.parameters);
  const EntryBuffers b = entryBuffers(g, f);
  recordEntries(f, "voxel", b, {},
                g.kernels<rl::VoxelCacheBuffers>(
                    params, {b.surfaces, b.proposals, b.shadingPoints, b.insertions, b.keys, b.seen,
                             b.claims, b.entryOfPixel}));
}

}  // namespace

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
    i.record = recordVoxel;
    return i;
  }();
  return info;
}

}  // namespace restlab
