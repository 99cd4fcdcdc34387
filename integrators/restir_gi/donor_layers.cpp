#include "integrators/restir_gi/donor_layers.h"

#include <algorithm>
#include <bit>

#include "core/base/packing.h"
#include "integrators/restir_gi/kept_params.h"

namespace restlab {

namespace {

// Results of the spatial_shift pass in the last frame.
class Exchanged {
 public:
  explicit Exchanged(const FrameSnapshot& kept)
      : quads_(kept.words("spatial_shift")), reservoirs_(kept.words("reservoirs")) {
    const rl::RestirGiParams params = giParamsOf(kept);
    places_ = params.spatialNeighbours;
    if (kept.frame == nullptr || quads_.empty()) return;
    // Number of donors as in giDonors().
    donors_ = kept.frame->stillFrames < params.longHistoryFrames ? params.spatialNeighbours
                                                                 : params.neighboursLongHistory;
  }
  uint32_t donors() const { return donors_; }
  uint32_t neighbour(size_t pixelIndex, uint32_t k) const {
    return quads_[4 * (pixelIndex * places_ + k) + 3];
  }
  bool hasSample(size_t pixelIndex) const {
    const size_t W = 4 * (pixelIndex * rl::RL_PATH_RESERVOIR_QUADS + rl::RL_PATH_SAMPLE_QUADS) + 2;
    return std::bit_cast<float>(reservoirs_[W]) > 0.0f;
  }
  // Returns whether the k-th neighbour sees the pixel's sample.
  bool isSeen(size_t pixelIndex, uint32_t k) const {
    const size_t at = 4 * (pixelIndex * places_ + k);
    const glm::vec3 F = packing_.unpackPositive3(quads_[at], quads_[at + 1]);
    return F.x + F.y + F.z > 0.0f;
  }

 private:
  std::span<const uint32_t> quads_, reservoirs_;
  mutable rl::Packing packing_;
  uint32_t places_ = 0, donors_ = 0;
};

float rejectedShare(const Exchanged& exchanged, size_t pixel) {
  uint32_t shifts = 0, rejected = 0;
  for (uint32_t k = 0; k < exchanged.donors(); ++k) {
    const uint32_t neighbour = exchanged.neighbour(pixel, k);
    if (neighbour == rl::RL_INVALID || !exchanged.hasSample(neighbour)) continue;
    ++shifts;
    rejected += exchanged.isSeen(neighbour, k) ? 0 : 1;
  }
  return shifts == 0 ? 0.0f : float(rejected) / float(shifts);
}

float pairOf(const Exchanged& exchanged, size_t pixel) {
  if (exchanged.donors() == 0) return 0.0f;
  const uint32_t neighbour = exchanged.neighbour(pixel, 0);
  return neighbour == rl::RL_INVALID ? 0.0f : 1.0f + float(std::min<size_t>(neighbour, pixel));
}

}  // namespace

std::vector<LayerInfo> giDonorLayers() {
  LayerInfo rejected, neighbour;
  rejected.name = "rejected_shifts";
  rejected.summary =
      "share of the samples of the pixel's donors over space that it does not see, 0 to 1";
  rejected.values = [](const FrameSnapshot& kept) {
    return [exchanged = Exchanged(kept)](size_t pixel) { return rejectedShare(exchanged, pixel); };
  };
  neighbour.name = "partner";
  neighbour.summary =
      "pairs of pixels that serve each other over space: 1 + the lower number of the pixel's first "
      "pair";
  neighbour.isName = true;
  neighbour.values = [](const FrameSnapshot& kept) {
    return [exchanged = Exchanged(kept)](size_t pixel) { return pairOf(exchanged, pixel); };
  };
  for (LayerInfo* layer : {&rejected, &neighbour})
    layer->enabledIf.parameter = "spatial_neighbours";
  return {rejected, neighbour};
}

}  // namespace restlab
