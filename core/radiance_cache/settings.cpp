#include "core/radiance_cache/settings.h"

#include "core/radiance_cache/cells.h"

namespace restlab {

namespace {

constexpr const char* kEntries = "radiance_entries";
constexpr const char* kEvery = "radiance_every";
constexpr const char* kValidate = "radiance_validate";
constexpr const char* kSwept = "measured: docs/decisions/parameters-of-the-radiance-cache.md";
constexpr EnabledIf kIsCache = {"secondary", "cache"};

std::vector<ParameterInfo> parameterInfos() {
  return {
      {"secondary",
       std::string("trace"),
       0,
       0,
       {"trace", "cache"},
       "from the second vertex on a path is traced to its end, or ends in a cell of radiance where "
       "one serves: biased",
       "docs/decisions/radiance-cache.md"},
      {kEntries,
       int64_t{65536},
       1024,
       1 << 24,
       {},
       "cells of radiance; a point that finds no place is counted (cache_full)",
       kSwept},
      {"radiance_probes",
       int64_t{8},
       1,
       64,
       {},
       "places from its hash on where a cell may lie",
       kSwept},
      {kEvery,
       int64_t{16},
       1,
       1024,
       {},
       "one of so many pixels side by side has a path traced on from where it asks for a cell, "
       "each "
       "frame",
       "Mueller et al. 2021 train with 3 to 5 % of the paths"},
      {"radiance_pixels",
       16.0,
       0.25,
       1024.0,
       {},
       "side of a cell in pixels, rounded down to a power of two of metres",
       kSwept},
      {"radiance_footprint",
       1.0,
       0.0,
       1000.0,
       {},
       "spread of a path, in sides of the cell, from which on it may end there: no cell is seen "
       "sharply",
       "Mueller et al. 2021, section 3.4, compare it with that of the pixel"},
      {"radiance_roughness",
       0.2,
       0.0,
       1.0,
       {},
       "perceptual roughness below which a surface has no cells",
       kSwept,
       true},
      {"radiance_least",
       int64_t{4},
       1,
       1000,
       {},
       "samples of a cell before a path may end there",
       kSwept},
      {kValidate,
       int64_t{8},
       1,
       1 << 20,
       {},
       "one of so many cells has a path that it keeps traced again each frame; where it finds "
       "other "
       "light the cell begins anew (counted: light_changed)",
       "Ouyang et al. 2021 validate all of their samples every six frames; measured: "
       "docs/decisions/parameters-of-the-radiance-cache.md"},
      {"radiance_cap",
       int64_t{1024},
       8,
       1 << 20,
       {},
       "samples that the mean of a cell is of at most: older ones fade",
       kSwept},
  };
}

BufferInfo ofCells(const char* name, size_t bytes) {
  BufferInfo buffer{name, static_cast<uint32_t>(bytes)};
  buffer.entriesParameter = kEntries;
  return buffer;
}
BufferInfo ofGroups(const char* name, size_t bytes) {
  BufferInfo buffer{name, static_cast<uint32_t>(bytes)};
  buffer.onePerParameter = kEvery;
  return buffer;
}

PassInfo pass(const std::string& what, const std::string& again = "") {
  PassInfo info{"radiance_" + what + again, "radiance_" + what, false};
  info.hasFeatures = what == "trace" || what == "insertions" || what == "validate";
  const bool isOfCells = what == "clear" || what == "fill" || what == "validate";
  (isOfCells ? info.entriesParameter : info.onePerParameter) = isOfCells ? kEntries : kEvery;
  if (what == "validate") info.onePerParameter = kValidate;
  return info;
}

}  // namespace

const PartInfo& radiancePartInfo() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "radiance";
    i.summary = "cells in space with the radiance that leaves them, in which paths may end";
    i.parameters = parameterInfos();
    i.buffers = {ofCells("radiance_keys", 2 * sizeof(uint32_t)),
                 ofCells("radiance_places", 16),
                 ofCells("radiance_light", 16),
                 ofGroups("radiance_rays", size_t{16} * rl::RL_RADIANCE_RAY_QUADS),
                 ofGroups("radiance_points", size_t{16} * rl::RL_RADIANCE_POINT_QUADS),
                 ofCells("radiance_kept", size_t{16} * rl::RL_RADIANCE_KEPT_QUADS),
                 ofCells("radiance_seen", sizeof(uint32_t)),
                 ofCells("radiance_claims", sizeof(uint32_t)),
                 ofCells("radiance_insertions", sizeof(uint32_t) * rl::RL_ENTRY_INSERTIONS),
                 ofGroups("radiance_cell_of_group", sizeof(uint32_t))};
    // Twice: a query that loses a claim to another one has other hash slots to try.
    i.passes = {pass("clear"),
                pass("validate"),
                pass("trace"),
                pass("find"),
                pass("claim"),
                pass("resolve_claims"),
                pass("find_after_claims"),
                pass("claim", "_again"),
                pass("resolve_claims", "_again"),
                pass("find_after_claims", "_last"),
                pass("insertions"),
                pass("fill")};
    i.enabledIf = kIsCache;
    i.hasHistory = true;
    i.bias = BiasClass::biased;
    i.reasonUnused = [](const std::string& name, const ParameterMap& p) {
      const bool isOwn = name.starts_with("radiance_");
      return isOwn && !endsPaths(p) ? "secondary is trace" : "";
    };
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      rl::RadianceCellParams out{};
      out.entries.count = uintOf(p, kEntries);
      out.entries.insertEvery = uintOf(p, kEvery);
      out.entries.cap = float(uintOf(p, "radiance_cap"));
      out.cells = packRadiance(p);
      out.grid = out.cells.grid;
      out.validateEvery = uintOf(p, kValidate);
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

bool endsPaths(const ParameterMap& parameters) { return isEnabled(kIsCache, parameters); }

std::vector<std::string> radianceInputs() {
  return {"radiance_keys", "radiance_places", "radiance_light", "radiance_rays"};
}

rl::RadianceParams packRadiance(const ParameterMap& p) {
  rl::RadianceParams out{};
  if (!endsPaths(p)) return out;
  out.count = uintOf(p, kEntries);
  out.grid = {out.count, uintOf(p, "radiance_probes")};
  out.every = uintOf(p, kEvery);
  out.cellPixels = floatOf(p, "radiance_pixels");
  out.footprint = floatOf(p, "radiance_footprint");
  const float roughness = floatOf(p, "radiance_roughness");
  out.minAlpha = roughness * roughness;
  out.leastCount = float(uintOf(p, "radiance_least"));
  return out;
}

}  // namespace restlab
