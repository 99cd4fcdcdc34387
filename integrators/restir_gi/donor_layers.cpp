#include "integrators/restir_gi/donor_layers.h"

#include <algorithm>
#include <bit>

#include "core/packing.h"
#include "integrators/restir_gi/kept_params.h"

namespace restlab {

namespace {

// Results of the exchange pass in the last frame.
class Exchanged {
 public:
  explicit Exchanged(const Kept& kept)
      : quads_(kept.words("exchange")), reservoirs_(kept.words("reservoirs")) {
    const rl::RestirGiParams params = giParamsOf(kept);
    places_ = params.spatialNeighbours;
    if (kept.frame == nullptr || quads_.empty()) return;
    // Number of donors as in giDonors().
    donors_ = kept.frame->stillFrames < params.settledFrames ? params.spatialNeighbours
                                                             : params.agedNeighbours;
  }
  uint32_t donors() const { return donors_; }
  uint32_t partner(size_t slot, uint32_t k) const { return quads_[4 * (slot * places_ + k) + 3]; }
  bool hasSample(size_t slot) const {
    const size_t W = 4 * (slot * rl::RL_PATH_RESERVOIR_QUADS + rl::RL_PATH_SAMPLE_QUADS) + 2;
    return std::bit_cast<float>(reservoirs_[W]) > 0.0f;
  }
  // Returns whether the k-th partner sees the slot's sample.
  bool isSeen(size_t slot, uint32_t k) const {
    const size_t at = 4 * (slot * places_ + k);
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
    const uint32_t partner = exchanged.partner(pixel, k);
    if (partner == rl::RL_INVALID || !exchanged.hasSample(partner)) continue;
    ++shifts;
    rejected += exchanged.isSeen(partner, k) ? 0 : 1;
  }
  return shifts == 0 ? 0.0f : float(rejected) / float(shifts);
}

float pairOf(const Exchanged& exchanged, size_t pixel) {
  if (exchanged.donors() == 0) return 0.0f;
  const uint32_t partner = exchanged.partner(pixel, 0);
  return partner == rl::RL_INVALID ? 0.0f : 1.0f + float(std::min<size_t>(partner, pixel));
}

}  // namespace

std::vector<LayerInfo> giDonorLayers() {
  LayerInfo rejected, partner;
  rejected.name = "rejected_shifts";
  rejected.summary =
      "share of the samples of the pixel's donors over space that it does not see, 0 to 1";
  rejected.values = [](const Kept& kept) {
    return [exchanged = Exchanged(kept)](size_t pixel) { return rejectedShare(exchanged, pixel); };
  };
  partner.name = "partner";
  partner.summary =
      "pairs of pixels that serve each other over space: 1 + the lower number of the pixel's first "
      "pair";
  partner.isName = true;
  partner.values = [](const Kept& kept) {
    return [exchanged = Exchanged(kept)](size_t pixel) { return pairOf(exchanged, pixel); };
  };
  for (LayerInfo* layer : {&rejected, &partner}) layer->onlyWith.parameter = "spatial_neighbours";
  return {rejected, partner};
}

}  // namespace restlab
