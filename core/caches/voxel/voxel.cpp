// Host side of the voxel cache.
#include "core/caches/voxel/voxel.h"

#include "core/caches/entries/passes.h"
#include "core/caches/entries/settings.h"
#include "core/frame/schema.h"
#include "core/resampling/pair_settings.h"

namespace restlab {

namespace {

struct VoxelSettings {
  double cellPixels = 4.0;
};

const Schema<VoxelSettings>& schema() {
  static const Schema<VoxelSettings> all = {
      Parameter<VoxelSettings>(&VoxelSettings::cellPixels, "voxel_pixels", Range{0.25, 256.0},
                               "side of a cell in pixels, rounded down to a power of two of metres",
                               "measured: docs/decisions/parameters-of-entries.md")};
  return all;
}

void recordVoxel(FrameGraph& g, const FrameInfo& f) {
  rl::VoxelCacheParams params{};
  params.entries = packEntries(f.parameters);
  params.grid = packGrid(f.parameters);
  params.cellPixels = float(schema().read(f.parameters).cellPixels);
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
    append(i.parameters, schema().infos());
    i.record = recordVoxel;
    return i;
  }();
  return info;
}

}  // namespace restlab
