#include "experiments/runner/reference/relmse_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace restlab {

namespace {

constexpr int kBitsOfDoubling = 2;                            // 2^2 checks per doubling
constexpr size_t kKept = (size_t(1) << kBitsOfDoubling) + 1;  // both ends of a doubling

}  // namespace

bool RelmseChecks::isDue(uint64_t spp) {
  if (spp < kFirstSpp) return false;
  const int below = std::bit_width(spp) - 1 - kBitsOfDoubling;
  return (spp & ((uint64_t(1) << below) - 1)) == 0;
}

void RelmseChecks::add(double relmse) {
  last_.push_back(relmse);
  if (last_.size() > kKept) last_.erase(last_.begin());
}

double RelmseChecks::sinceHalf() const {
  const bool isUnknown =
      std::any_of(last_.begin(), last_.end(), [](double relmse) { return std::isnan(relmse); });
  if (last_.size() < kKept || isUnknown) return std::numeric_limits<double>::quiet_NaN();
  return *std::max_element(last_.begin(), last_.end());
}

}  // namespace restlab
