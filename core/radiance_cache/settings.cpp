#include "core/radiance_cache/settings.h"

#include "core/frame/frame_graph.h"
#include "core/frame/schema.h"
#include "core/radiance_cache/cells.h"

namespace restlab {

namespace {

constexpr const char* kSwept = "measured: docs/decisions/parameters-of-the-radiance-cache.md";
constexpr EnabledIf kIsCache = {"secondary", "cache"};

struct RadianceSettings {
  std::string secondary = "trace";
  uint32_t count = 65536;
  uint32_t probes = 8;
  uint32_t every = 16;
  double cellPixels = 16.0;
  double footprint = 1.0;
  double roughness = 0.2;
  uint32_t leastCount = 4;
  uint32_t validateEvery = 8;
  uint32_t cap = 1024;
};

const Schema<RadianceSettings>& schema() {
  static const Schema<RadianceSettings> all = {
      Parameter<RadianceSettings>(&RadianceSettings::secondary, "secondary",
                                  Choices{"trace", "cache"},
                                  "from the second vertex on a path is traced to its end, or ends "
                                  "in a cell of radiance where "
                                  "one serves: biased",
                                  "docs/decisions/radiance-cache.md"),
      Parameter<RadianceSettings>(
          &RadianceSettings::count, "radiance_entries", Range{1024, 1 << 24},
          "cells of radiance; a point that finds no place is counted (cache_full)", kSwept),
      Parameter<RadianceSettings>(&RadianceSettings::probes, "radiance_probes", Range{1, 64},
                                  "places from its hash on where a cell may lie", kSwept),
      Parameter<RadianceSettings>(
          &RadianceSettings::every, "radiance_every", Range{1, 1024},
          "one of so many pixels side by side has a path traced on from where it asks for a cell, "
          "each "
          "frame",
          "Mueller et al. 2021 train with 3 to 5 % of the paths"),
      Parameter<RadianceSettings>(
          &RadianceSettings::cellPixels, "radiance_pixels", Range{0.25, 1024.0},
          "side of a cell in pixels, rounded down to a power of two of metres", kSwept),
      Parameter<RadianceSettings>(
          &RadianceSettings::footprint, "radiance_footprint", Range{0.0, 1000.0},
          "spread of a path, in sides of the cell, from which on it may end there: no cell is seen "
          "sharply",
          "Mueller et al. 2021, section 3.4, compare it with that of the pixel"),
      Parameter<RadianceSettings>(&RadianceSettings::roughness, "radiance_roughness",
                                  Range{0.0, 1.0},
                                  "perceptual roughness below which a surface has no cells", kSwept)
          .beginsHistory(),
      Parameter<RadianceSettings>(&RadianceSettings::leastCount, "radiance_least", Range{1, 1000},
                                  "samples of a cell before a path may end there", kSwept),
      Parameter<RadianceSettings>(
          &RadianceSettings::validateEvery, "radiance_validate", Range{1, 1 << 20},
          "one of so many cells has a path that it keeps traced again each frame; where it finds "
          "other "
          "light the cell begins anew (counted: light_changed)",
          "Ouyang et al. 2021 validate all of their samples every six frames; measured: "
          "docs/decisions/parameters-of-the-radiance-cache.md"),
      Parameter<RadianceSettings>(&RadianceSettings::cap, "radiance_cap", Range{8, 1 << 20},
                                  "samples that the mean of a cell is of at most: older ones fade",
                                  kSwept)};
  return all;
}

void recordRadiance(FrameGraph& g, const FrameInfo& f) {
  const RadianceSettings s = schema().read(f.parameters);
  rl::RadianceCellParams params{};
  params.entries.count = s.count;
  params.entries.insertEvery = s.every;
  params.entries.cap = float(s.cap);
  params.cells = packRadiance(f.parameters);
  params.grid = params.cells.grid;
  params.validateEvery = s.validateEvery;
  const size_t cells = params.entries.count, groups = f.groups(params.entries.insertEvery);
  constexpr uint32_t kWord = sizeof(uint32_t);
  const Buffer keys = g.buffer("radiance_keys", cells, 2 * kWord);
  const Buffer places = g.buffer("radiance_places", cells, 16);
  const Buffer light = g.buffer("radiance_light", cells, 16);
  const Buffer rays = g.buffer("radiance_rays", groups, 16 * rl::RL_RADIANCE_RAY_UVEC4S);
  const Buffer points = g.buffer("radiance_points", groups, 16 * rl::RL_RADIANCE_POINT_UVEC4S);
  const Buffer kept = g.buffer("radiance_kept", cells, 16 * rl::RL_RADIANCE_KEPT_UVEC4S);
  const Buffer seen = g.buffer("radiance_seen", cells, kWord);
  const Buffer claims = g.buffer("radiance_claims", cells, kWord);
  const Buffer insertions = g.buffer("radiance_insertions", cells, kWord * rl::RL_ENTRY_INSERTIONS);
  const Buffer cellOfGroup = g.buffer("radiance_cell_of_group", groups, kWord);
  g.shared.cellKeys = keys;
  g.shared.cellPlaces = places;
  g.shared.cellLight = light;
  g.shared.cellRays = rays;

  const Kernels kernels = g.kernels<rl::RadianceCellBuffers>(
      params, {keys, places, light, rays, points, kept, seen, claims, insertions, cellOfGroup});
  const auto pass = [&](const std::string& what, const std::string& again = "") -> GraphPass& {
    return kernels.pass("radiance_" + what + again, "radiance_" + what);
  };
  const auto find = [&](const std::string& what, const std::string& again = "") {
    pass(what, again).over(groups).reads({points, keys}).updates({seen, cellOfGroup});
  };
  const auto claim = [&](const std::string& again = "") {
    pass("claim", again).over(groups).reads({points, seen}).updates({claims, cellOfGroup});
    pass("resolve_claims", again)
        .over(groups)
        .reads({points, claims, cellOfGroup})
        .updates({keys, places, light, kept, seen});
  };
  pass("clear").over(cells).writes({claims, insertions});
  const size_t validated = (cells + params.validateEvery - 1) / params.validateEvery;
  pass("validate").over(validated).reads({seen}).updates({kept, light});
  pass("trace").over(groups).reads({rays}).writes({points});
  find("find");
  // Twice: a query that loses a claim to another one has other hash slots to try.
  claim();
  find("find_after_claims");
  claim("_again");
  find("find_after_claims", "_last");
  pass("insertions").over(groups).reads({points, cellOfGroup, places}).updates({insertions});
  pass("fill").over(cells).reads({insertions, points, rays}).updates({light, kept});
}

}  // namespace

const PartInfo& radiancePartInfo() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "radiance";
    i.summary = "cells in space with the radiance that leaves them, in which paths may end";
    i.parameters = schema().infos();
    i.record = recordRadiance;
    i.enabledIf = kIsCache;
    i.hasHistory = true;
    i.bias = BiasClass::biased;
    i.reasonUnused = [](const std::string& name, const ParameterMap& p) {
      const bool isOwn = name.starts_with("radiance_");
      return isOwn && !endsPaths(p) ? "secondary is trace" : "";
    };
    return i;
  }();
  return info;
}

bool endsPaths(const ParameterMap& parameters) { return isEnabled(kIsCache, parameters); }

rl::RadianceParams packRadiance(const ParameterMap& parameters) {
  rl::RadianceParams out{};
  if (!endsPaths(parameters)) return out;
  const RadianceSettings s = schema().read(parameters);
  out.count = s.count;
  out.grid = {s.count, s.probes};
  out.every = s.every;
  out.cellPixels = float(s.cellPixels);
  out.footprint = float(s.footprint);
  const auto roughness = float(s.roughness);
  out.minAlpha = roughness * roughness;
  out.leastCount = float(s.leastCount);
  return out;
}

}  // namespace restlab
