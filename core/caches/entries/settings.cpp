#include "core/caches/entries/settings.h"

#include "core/caches/entries/layers.h"

namespace restlab {

namespace {

constexpr const char* kSwept = "measured: docs/decisions/parameters-of-entries.md";

std::vector<ParameterInfo> entryParameters() {
  return {
      {kEntryCount,
       int64_t{65536},
       1024,
       1 << 24,
       {},
       "entries of the cache; a surface that finds no place is counted (cache_full)",
       kSwept},
      {"entry_proposals",
       int64_t{2},
       1,
       rl::RL_MAX_DONORS,
       {},
       "entries that a pixel takes as donors in frames of a new view",
       kSwept},
      {"entry_probes",
       int64_t{8},
       1,
       64,
       {},
       "places from its hash on where an entry may lie",
       kSwept},
      {"entry_spread",
       1.5,
       0.0,
       16.0,
       {},
       "how far beside a pixel's point its further donors lie, in sides of a cell or radii of a "
       "disc",
       kSwept},
      {"entry_cap", 20.0, 1.0, 1000.0, {}, "confidence that an entry keeps, in samples", kSwept},
      {"feed_every",
       int64_t{2},
       1,
       256,
       {},
       "one of so many pixels side by side offers its sample to its entry each frame",
       kSwept}};
}

}  // namespace

CacheInfo entryCache(const std::string& name, const std::string& summary) {
  CacheInfo i;
  i.name = name;
  i.summary = summary;
  i.parameters = entryParameters();
  i.needsSurfaces = true;
  i.hasHistory = true;
  i.reasonUnused = [cache = name + "_"](const std::string& what, const ParameterMap& p) {
    const bool isOwn = what.starts_with("entr") || what == "feed_every" || what.starts_with(cache);
    const auto temporal = p.find("temporal");
    const bool isAsked = temporal == p.end() || std::get<bool>(temporal->second);
    return isOwn && !isAsked ? "temporal is false" : "";
  };
  i.layers = entryLayers();
  return i;
}

rl::EntryParams packEntries(const ParameterMap& parameters) {
  if (!parameters.contains(kEntryCount)) return {};
  return {uintOf(parameters, kEntryCount), uintOf(parameters, "entry_proposals"),
          uintOf(parameters, "feed_every"), floatOf(parameters, "entry_cap"),
          floatOf(parameters, "entry_spread")};
}

rl::GridParams packGrid(const ParameterMap& parameters) {
  return {uintOf(parameters, kEntryCount), uintOf(parameters, "entry_probes")};
}

}  // namespace restlab
