#include "core/caches/entries/settings.h"

#include "core/caches/entries/layers.h"
#include "core/frame/schema.h"

namespace restlab {

namespace {

constexpr const char* kSwept = "measured: docs/decisions/parameters-of-entries.md";

struct EntrySettings {
  uint32_t count = 65536;
  uint32_t proposals = 2;
  uint32_t probes = 8;
  double spread = 1.5;
  double cap = 20.0;
  uint32_t insertEvery = 2;
};

const Schema<EntrySettings>& schema() {
  static const Schema<EntrySettings> all = {
      Parameter<EntrySettings>(
          &EntrySettings::count, kEntryCount, Range{1024, 1 << 24},
          "entries of the cache; a surface that finds no place is counted (cache_full)", kSwept),
      Parameter<EntrySettings>(
          &EntrySettings::proposals, "entry_proposals", Range{1, rl::RL_MAX_DONORS},
          "entries that a pixel takes as donors in frames of a new view", kSwept),
      Parameter<EntrySettings>(&EntrySettings::probes, "entry_probes", Range{1, 64},
                               "places from its hash on where an entry may lie", kSwept),
      Parameter<EntrySettings>(
          &EntrySettings::spread, "entry_spread", Range{0.0, 16.0},
          "how far beside a pixel's point its further donors lie, in sides of a cell or radii of a "
          "disc",
          kSwept),
      Parameter<EntrySettings>(&EntrySettings::cap, "entry_cap", Range{1.0, 1000.0},
                               "confidence that an entry keeps, in samples", kSwept),
      Parameter<EntrySettings>(
          &EntrySettings::insertEvery, "feed_every", Range{1, 256},
          "one of so many pixels side by side inserts its sample into its entry each frame",
          kSwept)};
  return all;
}

}  // namespace

CacheInfo entryCache(const std::string& name, const std::string& summary) {
  CacheInfo i;
  i.name = name;
  i.summary = summary;
  i.parameters = schema().infos();
  i.needsSurfaces = true;
  i.hasHistory = true;
  i.reasonUnused = [cache = name + "_"](const std::string& what, const ParameterMap& p) {
    const bool isOwn = what.starts_with("entr") || what == "feed_every" || what.starts_with(cache);
    const auto temporal = p.find("temporal");
    const bool isTemporal = temporal == p.end() || std::get<bool>(temporal->second);
    return isOwn && !isTemporal ? "temporal is false" : "";
  };
  i.layers = entryLayers();
  return i;
}

rl::EntryParams packEntries(const ParameterMap& parameters) {
  if (!parameters.contains(kEntryCount)) return {};
  const EntrySettings s = schema().read(parameters);
  return {s.count, s.proposals, s.insertEvery, float(s.cap), float(s.spread)};
}

rl::GridParams packGrid(const ParameterMap& parameters) {
  const EntrySettings s = schema().read(parameters);
  return {s.count, s.probes};
}

}  // namespace restlab
