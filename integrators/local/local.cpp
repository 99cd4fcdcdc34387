// Registers `local`: lighting models, shading, shadows, occlusion and reflections, each a value of
// a parameter.
#include "integrators/local/local.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/gbuffer/first_hits.h"
#include "core/scene/compiled/compiled_scene.h"
#include "integrators/local/local_settings.h"
#undef RL_KERNEL_BUFFERS
#undef RL_KERNEL_PARAMS
#include "core/gbuffer/gbuffer_pass.h"

namespace restlab {

namespace {

// Radius of occlusion that follows the scene, over the diagonal of its box.
constexpr float kOwnRadius = 0.1f;
// Triangles that a raster pass draws, with three corners each.
constexpr uint64_t kMostParts = uint64_t{1} << 29;

// The vertex stage has one light for all pixels of a triangle: of a formula, without occlusion.
bool isVertexLit(const LocalSettings& s) {
  return s.shading == rl::RL_LOCAL_GOURAUD && s.model != rl::RL_LOCAL_CLOSURE && s.directLight &&
         s.occlusion == 0 && s.ambientShare == 0.0;
}

// Rejects parts that a draw cannot count.
uint32_t checkedDivisions(const LocalSettings& s, const CompiledScene& scene) {
  const uint64_t parts = uint64_t{scene.instancedTriangleCount()} << (2 * s.divisions);
  if (parts > kMostParts)
    failUsage(
        fmt::format("divisions = {}: {} triangles would become {}, more than {}; a smaller "
                    "number would be right",
                    s.divisions, scene.instancedTriangleCount(), parts, kMostParts));
  return s.divisions;
}

rl::LocalParams localParams(const LocalSettings& s, const FrameInfo& f) {
  const bool isRaster = rasterisesFirstHits(f.parameters);
  const bool isLit = isRaster && isVertexLit(s);
  rl::RasterParams raster{};
  if (isRaster) raster = rasterParams(*f.scene, false, isLit);
  if (isLit) raster.divisions = checkedDivisions(s, *f.scene);
  float radius = float(s.occlusionRadius);
  if (s.hasOwnRadius && radius == 0.0f)
    radius = kOwnRadius * glm::length(f.sceneBox[1] - f.sceneBox[0]);
  return {.raster = raster,
          .isRaster = isRaster ? 1u : 0u,
          .isVertexLit = isLit ? 1u : 0u,
          .divisions = s.divisions,
          .model = s.model,
          .shading = s.shading,
          .shadows = s.shadows,
          .occlusion = s.occlusion,
          .reflections = s.reflections,
          .combine = s.combine,
          .lightSamples = s.lightSamples,
          .occlusionRays = s.occlusionRays,
          .hasDirect = s.directLight ? 1u : 0u,
          .occlusionRadius = radius,
          .ambient = float(s.ambient),
          .ambientShare = float(s.ambientShare),
          .highlight = float(s.highlight),
          .highlightPower = float(s.highlightPower),
          .mapSquares = s.mapSquares,
          .mapSize = s.mapSize,
          .mapBias = float(s.mapBias),
          .mapFilter = s.mapFilter,
          .sceneLow = f.sceneBox[0],
          .sceneHigh = f.sceneBox[1]};
}

// Maps do not depend on the view, but frames of a still view alone can be told from others.
void recordLocal(FrameGraph& g, const FrameInfo& f) {
  const LocalSettings s = localSettings(f.parameters);
  const bool hasMaps = s.shadows == rl::RL_LOCAL_SHADOW_MAP && s.directLight;
  const bool readsScreen = s.occlusion == rl::RL_LOCAL_OCCLUSION_SCREEN;
  const size_t texels = size_t(s.mapSquares) * s.mapSize * s.mapSize;
  const size_t lampWords = 1 + size_t(s.mapSquares) * rl::RL_LOCAL_LAMP_UVEC4S;
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  const Buffer lamps = g.buffer("shadow_lamps", hasMaps ? lampWords : 0, 16);
  const Buffer maps = g.buffer("shadow_maps", hasMaps ? texels : 0, sizeof(float));
  const Buffer surfaces = g.buffer("local_surfaces", readsScreen ? f.pixels : 0, 16);
  const rl::LocalParams params = localParams(s, f);
  const bool isLit = params.isVertexLit != 0;
  const Buffer diffuse = g.buffer("corner_diffuse", isLit ? f.pixels : 0, 16);
  const Buffer highlight = g.buffer("corner_highlight", isLit ? f.pixels : 0, 16);
  const Buffer hits = isLit ? g.buffer("corner_hits", f.pixels, 16) : recordFilmHits(g, f);
  if (!g.shared.filmHits) g.shared.filmHits = hits;
  const Buffer boxes = g.shared.rasterBoxes;
  const Kernels kernels = g.kernels<rl::LocalBuffers>(
      params, {hits, diffuse, highlight, boxes, {}, {}, {}, radiance, lamps, maps, surfaces});
  if (hasMaps && f.lightAge == 0) {
    kernels.pass("shadow_lamps", "local_lamps").updates({lamps}).over(1).once(f.sceneAge == 0);
    kernels.pass("shadow_maps", "local_maps")
        .reads({lamps})
        .updates({maps})
        .over(texels)
        .once(f.sceneAge == 0);
  }
  if (isLit) {
    kernels.pass("local_corners", "raster_fragments")
        .rasters("local_corners")
        .reads({boxes, lamps, maps})
        .writes({hits, diffuse, highlight});
  }
  if (readsScreen && f.isNewView) {
    const Buffer centres = recordCentreHits(g, f);
    g.kernels<rl::GBufferBuffers>(rl::GBufferParams{.isRaster = centres ? 1u : 0u},
                                  {surfaces, centres})
        .pass("local_surfaces", "gbuffer")
        .reads({centres})
        .writes({surfaces});
  }
  kernels.pass("local", "local")
      .reads({hits, diffuse, highlight, lamps, maps, surfaces})
      .writes({radiance});
  g.shared.radiance = radiance;
}

}  // namespace

const IntegratorInfo& localIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "local";
    i.summary =
        "local lighting: lamps, ambient light, shadows, occlusion and reflections, each optional";
    i.modes = {
        {"biased", BiasClass::biased,
         "most light of more than one rough surface is left out, and mirrors and glass unless "
         "asked for; models and ambient light of its own stand for others"}};
    i.leavesOut = "light of more than one rough surface";
    i.parameters = localParameters();
    i.reasonUnused = whyLocalUnused;
    i.record = recordLocal;
    i.readsFirstHits = true;
    return i;
  }();
  return info;
}

}  // namespace restlab
