#include "experiments/runner/reference/relmse_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "experiments/runner/reference/reference_blocks.h"

namespace restlab {

namespace {

constexpr int kBitsOfDoubling = 2;  // 2^2 checks per doubling

}  // namespace

bool RelmseChecks::isDue(uint64_t spp) {
  if (spp < kFirstSpp) return false;
  if (spp > kBlockSpp && spp % kBlockSpp != 0) return false;
  const int below = std::bit_width(spp) - 1 - kBitsOfDoubling;
  return (spp & ((uint64_t(1) << below) - 1)) == 0;
}

void RelmseChecks::add(const RelmseCheck& check) {
  last_.push_back(check);
  while (last_.size() > 1 && last_[1].spp <= check.spp / 2) last_.erase(last_.begin());
}

double RelmseChecks::sinceHalf() const {
  const bool isUnknown = std::any_of(last_.begin(), last_.end(), [](const RelmseCheck& check) {
    return std::isnan(check.relmse);
  });
  if (last_.empty() || isUnknown || last_.front().spp > last_.back().spp / 2)
    return std::numeric_limits<double>::quiet_NaN();
  return std::max_element(
             last_.begin(), last_.end(),
             [](const RelmseCheck& a, const RelmseCheck& b) { return a.relmse < b.relmse; })
      ->relmse;
}

}  // namespace restlab
