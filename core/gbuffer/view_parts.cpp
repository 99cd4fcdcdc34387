#include "core/gbuffer/view_parts.h"

#include <algorithm>

#include "core/dialect/order.h"
#include "core/frame/frame_graph.h"
#include "core/gbuffer/first_hits.h"
#include "core/gbuffer/guide.h"
#undef RL_KERNEL_BUFFERS
#undef RL_KERNEL_PARAMS
#include "core/gbuffer/gbuffer_pass.h"

namespace restlab {

namespace {

// Surfaces change with the view alone. Kernels find those of a still view as the last frame's, too.
void recordSurfaces(FrameGraph& g, const FrameInfo& f) {
  History surfaces = g.history("gbuffer", f.pixels, 16);
  if (f.isNewView) {
    surfaces = g.advance(surfaces);
    const Buffer hits = recordCentreHits(g, f);
    g.kernels<rl::GBufferBuffers>(rl::GBufferParams{.isRaster = hits ? 1u : 0u},
                                  {surfaces.now, hits})
        .pass("gbuffer", "gbuffer")
        .reads({hits})
        .writes({surfaces.now});
  } else {
    surfaces.previous = surfaces.now;
  }
  g.shared.surfaces = surfaces;
}

void recordFeatures(FrameGraph& g, const FrameInfo& f) {
  const Buffer surfaces = g.shared.surfaces.now;
  const History features = g.advance(g.history("guide", f.pixels, 16 * rl::RL_GUIDE_UVEC4S));
  const Buffer motion = g.buffer("motion", f.pixels, 16);
  const Buffer hits = recordFilmHits(g, f);
  rl::GuideParams params{};
  if (hits) params.flags |= rl::RL_GUIDE_RASTER;
  if (f.parameters.contains("demodulate")) {
    const std::string& what = textOf(f.parameters, "demodulate");
    params.flags |= what == "none" ? 0u : rl::RL_GUIDE_DIFFUSE;
    params.flags |= what == "all" ? rl::RL_GUIDE_SPECULAR : 0u;
  }
  g.kernels<rl::GuideBuffers>(params, {surfaces, features.now, features.previous, motion, hits})
      .pass("guide", "guide")
      .reads({surfaces, features.previous, hits})
      .writes({features.now, motion});
  g.shared.features = features;
  g.shared.motion = motion;
}

const PartInfo& surfacesPart() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "gbuffer";
    i.summary = "what each pixel shows at its centre";
    i.record = recordSurfaces;
    i.hasHistory = true;
    return i;
  }();
  return info;
}

const PartInfo& featuresPart() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "guide";
    i.summary = "what the film samples show, for denoisers";
    i.needsSurfaces = true;
    i.record = recordFeatures;
    i.hasHistory = true;
    return i;
  }();
  return info;
}

}  // namespace

std::vector<const PartInfo*> withViewParts(std::vector<const PartInfo*> parts) {
  const auto anyNeeds = [&](bool PartInfo::*buffers) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const PartInfo* part) { return part->*buffers; });
  };
  if (anyNeeds(&PartInfo::needsFeatures)) parts.insert(parts.begin(), &featuresPart());
  if (anyNeeds(&PartInfo::needsSurfaces)) parts.insert(parts.begin(), &surfacesPart());
  std::stable_partition(parts.begin(), parts.end(),
                        [](const PartInfo* part) { return part == &firstHitsPartInfo(); });
  return parts;
}

}  // namespace restlab
