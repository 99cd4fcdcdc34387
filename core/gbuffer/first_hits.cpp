#include "core/gbuffer/first_hits.h"

#include <algorithm>
#include <bit>

#include "core/backend/embree.h"
#include "core/raster/raster_pass.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {

namespace {

struct SceneExtent {
  float size;   // diagonal of the box without strays, metres
  float reach;  // RasterParams::reach
};

Buffer recordHits(FrameGraph& g, const FrameInfo& f, const char* name, bool isAtCentre) {
  const Buffer hits = g.buffer(name, f.pixels, 16);
  const Buffer boxes = g.shared.rasterBoxes;
  const rl::RasterPassParams params{rasterParams(*f.scene, isAtCentre, false)};
  g.kernels<rl::RasterPassBuffers>(params, {hits, {}, {}, boxes, {}, {}, {}})
      .pass(name, "raster_fragments")
      .rasters("first_hits_corners")
      .reads({boxes})
      .writes({hits});
  return hits;
}

void recordBoxes(FrameGraph& g, const FrameInfo& f) {
  const bool hasShapes = f.scene != nullptr && (f.scene->features() & rl::RL_FEATURE_SHAPES) != 0;
  if (hasShapes && rasterisesFirstHits(f.parameters))
    g.shared.rasterBoxes = g.table("raster_boxes", rasterBoxWords(*f.scene), 16);
}

}  // namespace

const PartInfo& firstHitsPartInfo() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "first_hits";
    i.summary = "who finds the surfaces that the eye sees straight";
    ParameterInfo p;
    p.name = "first_hit";
    p.defaultValue = std::string("rays");
    p.choices = {"rays", "raster"};
    p.help =
        "surfaces that the eye sees straight are found by rays, or by a rasteriser: for local "
        "lighting, denoisers, and the surfaces that histories follow";
    p.source = "rays meet shapes exactly, and each pixel has its own film sample";
    p.beginsHistory = true;
    i.parameters = {p};
    i.record = recordBoxes;
    return i;
  }();
  return info;
}

bool rasterisesFirstHits(const ParameterMap& parameters) {
  const auto found = parameters.find("first_hit");
  return found != parameters.end() && std::get<std::string>(found->second) == "raster";
}

rl::RasterParams rasterParams(const CompiledScene& scene, bool isAtCentre, bool hasLight) {
  const auto measure = [&]() -> CompiledScene::Derived {
    const std::array<glm::vec3, 2> box = sceneBoxOf(scene);
    double reach = 0.0;
    for (const glm::dvec3& corner : worldBounds(scene.source()))
      reach = std::max(reach, glm::length(glm::abs(corner - scene.origin())));
    return std::make_shared<const SceneExtent>(
        SceneExtent{std::max(glm::length(box[1] - box[0]), 1e-20f), float(2.0 * reach)});
  };
  const auto extent =
      std::static_pointer_cast<const SceneExtent>(scene.derived("raster extent", measure));
  return {.isAtCentre = isAtCentre ? 1u : 0u,
          .nearest = rl::RL_RASTER_NEAREST * extent->size,
          .reach = extent->reach,
          .hasLight = hasLight ? 1u : 0u,
          .divisions = 0};
}

std::shared_ptr<const std::vector<uint32_t>> rasterBoxWords(const CompiledScene& scene) {
  const auto make = [&]() -> CompiledScene::Derived {
    const auto words = std::make_shared<std::vector<uint32_t>>();
    if ((scene.features() & rl::RL_FEATURE_SHAPES) == 0) return words;
    for (const RTCBounds& box : scene.bvhInput().shapeBoxes) {
      for (const float value : {box.lower_x, box.lower_y, box.lower_z, 0.0f, box.upper_x,
                                box.upper_y, box.upper_z, 0.0f})
        words->push_back(std::bit_cast<uint32_t>(value));
    }
    return words;
  };
  return std::static_pointer_cast<const std::vector<uint32_t>>(scene.derived("raster boxes", make));
}

Buffer recordCentreHits(FrameGraph& g, const FrameInfo& f) {
  if (!g.shared.centreHits && rasterisesFirstHits(f.parameters))
    g.shared.centreHits = recordHits(g, f, "centre_hits", true);
  return g.shared.centreHits;
}

Buffer recordFilmHits(FrameGraph& g, const FrameInfo& f) {
  if (!g.shared.filmHits && rasterisesFirstHits(f.parameters))
    g.shared.filmHits = recordHits(g, f, "film_hits", false);
  return g.shared.filmHits;
}

}  // namespace restlab
