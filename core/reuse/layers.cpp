#include "core/reuse/layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/base/packing.h"
#include "core/caches/entries/layers.h"
#include "core/caches/entries/settings.h"
#include "core/reuse/passes.h"
#include "core/reuse/reuse.h"

namespace restlab {

namespace {

static_assert(sizeof(rl::CacheMerge::donorId) / sizeof(uint32_t) >= rl::RL_MAX_DONORS &&
              sizeof(rl::CacheMerge::donorId) / sizeof(uint32_t) >= rl::RL_ENTRY_INSERTIONS);

// Words of a reservoir's state, as reservoirStateWrite() lays it out behind the sample.
class ReservoirWords {
 public:
  explicit ReservoirWords(uint32_t uvec4s) : words_(4 * size_t{uvec4s}) {}
  float weight(std::span<const uint32_t> all, size_t index) const { return number(all, index, 2); }
  float confidence(std::span<const uint32_t> all, size_t index) const {
    return number(all, index, 3);
  }

 private:
  float number(std::span<const uint32_t> all, size_t index, size_t word) const {
    return std::bit_cast<float>(all[words_ * (index + 1) - 4 * rl::RL_STATE_UVEC4S + word]);
  }
  size_t words_;
};

// Parameters of the frame as kernels had them; zeros if no session has rendered it.
rl::ReuseParams paramsOf(const FrameSnapshot& snapshot) {
  rl::ReuseParams params{};
  if (snapshot.params.size() >= sizeof params)
    std::memcpy(&params, snapshot.params.data(), sizeof params);
  return params;
}

// Results of the spatial_shift pass in the last frame.
class Exchanged {
 public:
  Exchanged(const FrameSnapshot& snapshot, const ReservoirWords& reservoir)
      : reservoir_(reservoir) {
    const rl::ReuseParams params = paramsOf(snapshot);
    reservoirs_ = snapshot.words(lastRoundsReservoirs(params.spatialRounds));
    if (snapshot.frame == nullptr || params.spatialNeighbours == 0) return;
    // Number of donors as in spatialDonors().
    donors_ = snapshot.frame->stillFrames < params.youngFrames ? params.spatialNeighbours
                                                               : params.agedNeighbours;
    for (uint32_t k = 0; k < donors_; ++k) shifts_[k] = snapshot.words(pairedShiftsName(k));
    if (donors_ > 0 && shifts_[0].empty()) donors_ = 0;
  }
  uint32_t donors() const { return donors_; }
  uint32_t neighbour(size_t pixelIndex, uint32_t k) const { return shifts_[k][4 * pixelIndex + 3]; }
  bool hasSample(size_t pixelIndex) const {
    return reservoir_.weight(reservoirs_, pixelIndex) > 0.0f;
  }
  // Returns whether the pixel's sample, shifted to the k-th neighbour, has light.
  bool hasLight(size_t pixelIndex, uint32_t k) const {
    const size_t at = 4 * pixelIndex;
    const glm::vec3 F = packing_.unpackPositive3(shifts_[k][at], shifts_[k][at + 1]);
    return F.x + F.y + F.z > 0.0f;
  }

 private:
  std::array<std::span<const uint32_t>, rl::RL_MAX_DONORS> shifts_;
  std::span<const uint32_t> reservoirs_;
  ReservoirWords reservoir_;
  mutable rl::Packing packing_;
  uint32_t donors_ = 0;
};

float rejectedShare(const Exchanged& exchanged, size_t pixel) {
  uint32_t shifts = 0, rejected = 0;
  for (uint32_t k = 0; k < exchanged.donors(); ++k) {
    const uint32_t neighbour = exchanged.neighbour(pixel, k);
    if (neighbour == rl::RL_INVALID || !exchanged.hasSample(neighbour)) continue;
    ++shifts;
    rejected += exchanged.hasLight(neighbour, k) ? 0 : 1;
  }
  return shifts == 0 ? 0.0f : float(rejected) / float(shifts);
}

float pairOf(const Exchanged& exchanged, size_t pixel) {
  if (exchanged.donors() == 0) return 0.0f;
  const uint32_t neighbour = exchanged.neighbour(pixel, 0);
  return neighbour == rl::RL_INVALID ? 0.0f : 1.0f + float(std::min<size_t>(neighbour, pixel));
}

std::vector<LayerInfo> donorLayers(const ReservoirWords& reservoir) {
  LayerInfo rejected, neighbour;
  rejected.name = "rejected_shifts";
  rejected.summary =
      "share of the shifts of spatial donors' samples to the pixel that have no light there "
      "(occluded, "
      "undefined or dark), 0 to 1";
  rejected.values = [reservoir](const FrameSnapshot& snapshot) {
    return [exchanged = Exchanged(snapshot, reservoir)](size_t pixel) {
      return rejectedShare(exchanged, pixel);
    };
  };
  neighbour.name = "partner";
  neighbour.summary =
      "pairs of pixels that serve each other over space: 1 + the lower number of the pixel's first "
      "pair";
  neighbour.isName = true;
  neighbour.values = [reservoir](const FrameSnapshot& snapshot) {
    return [exchanged = Exchanged(snapshot, reservoir)](size_t pixel) {
      return pairOf(exchanged, pixel);
    };
  };
  for (LayerInfo* layer : {&rejected, &neighbour})
    layer->enabledIf.parameter = "spatial_neighbours";
  return {rejected, neighbour};
}

}  // namespace

std::vector<LayerInfo> reuseLayers(uint32_t reservoirUvec4s) {
  const ReservoirWords reservoir(reservoirUvec4s);
  LayerInfo confidence, age, ofEntry;
  confidence.name = "confidence";
  confidence.summary = "confidence of the pixel's reservoir";
  confidence.unit = "samples";
  confidence.values = [reservoir](const FrameSnapshot& snapshot) {
    return [reservoir, words = snapshot.words("reservoir_history")](size_t pixel) {
      return reservoir.confidence(words, pixel);
    };
  };
  age.name = "age";
  age.summary = "frames since the view was new or the light around the pixel was found changed";
  age.unit = "frames";
  age.values = [](const FrameSnapshot& snapshot) {
    // Layout as in unresampledCountPack().
    return [words = snapshot.words("unresampled_radiance")](size_t pixel) {
      return float(words[4 * pixel + 3] >> 16u);
    };
  };
  ofEntry.name = "entry_confidence";
  ofEntry.summary = "confidence of the reservoir of the pixel's entry";
  ofEntry.unit = "samples";
  ofEntry.enabledIf.parameter = kEntryCount;
  ofEntry.values = [reservoir](const FrameSnapshot& snapshot) {
    // A hash slot that a new entry has taken may still hold the reservoir of the previous one.
    const auto words = snapshot.words("entry_reservoirs"),
               shadingPoints = snapshot.words("shading_points");
    return ofPixelsEntry(snapshot, [reservoir, words, shadingPoints](uint32_t entry) {
      const bool hasShadingPoint =
          shadingPoints[4 * rl::RL_SHADING_POINT_UVEC4S * size_t{entry} + 6] >> 30u != 0;
      return hasShadingPoint ? reservoir.confidence(words, entry) : 0.0f;
    });
  };
  std::vector<LayerInfo> all = {confidence, age, ofEntry};
  for (LayerInfo& layer : donorLayers(reservoir)) all.push_back(std::move(layer));
  return all;
}

}  // namespace restlab
