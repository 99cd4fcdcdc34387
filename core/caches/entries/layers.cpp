#include "core/caches/entries/layers.h"

#include "core/caches/entries/settings.h"
#include "core/dialect/order.h"

namespace rl {
namespace {

// The dialect's hash.
struct Hashing {
  FrameData gFrame{};
#include "core/dialect/rng.glsl"
};

}  // namespace
}  // namespace rl

namespace restlab {

namespace {

// Hash slots where the entry of a key may lie: `probes` slots from `home` on; the first slot
// follows the last one.
struct Places {
  std::span<const uint32_t> keys;
  uint32_t count = 0, probes = 0;

  explicit Places(const FrameSnapshot& snapshot)
      : keys(snapshot.words("entry_keys")),
        count(packEntries(snapshot.parameters).count),
        probes(packGrid(snapshot.parameters).probes) {}
  // First hash slot of a key, as in gridPlace() (core/caches/entries/grid.glsl).
  uint32_t home(uint32_t entry) const {
    rl::Hashing hashing;
    const size_t at = size_t{2} * entry;
    return hashing.rngHash(hashing.rngHash(keys[at]) ^ keys[at + 1]) % count;
  }
  bool isTaken(uint32_t place) const { return keys[size_t{2} * (place % count)] != 0; }
};

float load(const Places& places, uint32_t entry) {
  uint32_t taken = 0;
  for (uint32_t i = 0; i < places.probes; ++i) taken += places.isTaken(places.home(entry) + i);
  return float(taken) / float(places.probes);
}

}  // namespace

std::function<float(size_t pixel)> ofPixelsEntry(const FrameSnapshot& snapshot,
                                                 std::function<float(uint32_t entry)> value) {
  return [entries = snapshot.words(kEntryOfPixel), value = std::move(value)](size_t pixel) {
    const uint32_t entry = entries[pixel];
    return entry < rl::RL_GRID_CLAIM ? value(entry) : 0.0f;
  };
}

std::vector<LayerInfo> entryLayers() {
  LayerInfo entry, loads, probes;
  entry.name = "entry";
  entry.summary = "1 + the place of the entry that the pixel's surface belongs to";
  entry.isName = true;
  entry.values = [](const FrameSnapshot& snapshot) {
    return ofPixelsEntry(snapshot, [](uint32_t place) { return float(place) + 1.0f; });
  };
  loads.name = "load";
  loads.summary = "share of the places that the pixel's entry might lie in that are taken";
  loads.values = [](const FrameSnapshot& snapshot) {
    const Places places(snapshot);
    return ofPixelsEntry(snapshot, [places](uint32_t place) { return load(places, place); });
  };
  probes.name = "probes";
  probes.summary = "places that are looked at until the pixel's entry is found";
  probes.unit = "places";
  probes.values = [](const FrameSnapshot& snapshot) {
    const Places places(snapshot);
    return ofPixelsEntry(snapshot, [places](uint32_t place) {
      return float((place + places.count - places.home(place)) % places.count + 1);
    });
  };
  return {entry, loads, probes};
}

}  // namespace restlab
