// Host side of the surflet cache.
#include "core/caches/surflet/surflet.h"

#include "core/caches/entries/passes.h"
#include "core/caches/entries/settings.h"
#include "core/frame/schema.h"
#include "core/resampling/pair_settings.h"

namespace restlab {

namespace {

struct SurfletSettings {
  double discPixels = 6.0;
};

const Schema<SurfletSettings>& schema() {
  static const Schema<SurfletSettings> all = {
      Parameter<SurfletSettings>(&SurfletSettings::discPixels, "surflet_pixels", Range{0.25, 256.0},
                                 "radius of a disc in pixels, where it is spawned",
                                 "measured: docs/decisions/parameters-of-entries.md")};
  return all;
}

void recordSurflet(FrameGraph& g, const FrameInfo& f) {
  rl::SurfletCacheParams params{};
  params.entries = packEntries(f.parameters);
  params.grid = packGrid(f.parameters);
  params.discPixels = float(schema().read(f.parameters).discPixels);
  params.similarity = packSimilarity(f.parameters);
  const EntryBuffers b = entryBuffers(g, f);
  const Buffer discs = g.buffer("discs", params.entries.count, 16 * rl::RL_SHADING_POINT_UVEC4S);
  recordEntries(f, "surflet", b, discs,
                g.kernels<rl::SurfletCacheBuffers>(
                    params, {b.surfaces, b.proposals, b.shadingPoints, b.insertions, b.keys, b.seen,
                             b.claims, b.entryOfPixel, discs}));
}

}  // namespace

const CacheInfo& surfletCacheInfo() {
  static const CacheInfo info = [] {
    CacheInfo i =
        entryCache("surflet", "discs on surfaces: each remembers at a surface point of its own");
    append(i.parameters, schema().infos());
    i.record = recordSurflet;
    return i;
  }();
  return info;
}

}  // namespace restlab
