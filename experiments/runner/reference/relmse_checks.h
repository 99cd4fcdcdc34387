// Decides when a reference has enough samples for a target error. The estimated error is noisy, and
// too low until a sample finds a rare bright path: stopping at the first estimate below the target
// would be too early. Estimates are therefore made at fixed numbers of samples, and all since half
// of the samples must agree.
#pragma once

#include <cstdint>
#include <vector>

namespace restlab {

// Estimated error of a reference of `spp` samples per pixel.
struct RelmseCheck {
  uint64_t spp = 0;
  double relmse = 0.0;
  uint64_t raysPath = 0;  // path rays of these samples
  bool operator==(const RelmseCheck&) const = default;
};

class RelmseChecks {
 public:
  // With fewer samples the two halves say too little about their own error.
  static constexpr uint64_t kFirstSpp = 16;

  RelmseChecks() = default;
  // Continues with the checks kept from an earlier call.
  explicit RelmseChecks(std::vector<RelmseCheck> kept) : last_(std::move(kept)) {}

  // Due four times per doubling: at 16, 20, 24, 28, 32, 40, 48, ... samples, beyond a block of
  // samples (reference_blocks.h) at the ends of blocks alone. Fixed numbers let an interrupted
  // rendering, and blocks rendered elsewhere, stop at the same sample as one rendering.
  static bool isDue(uint64_t spp);
  // Adds the next check that is due.
  void add(const RelmseCheck& check);
  // Returns the estimates that later decisions need, the newest last.
  const std::vector<RelmseCheck>& kept() const { return last_; }
  // Returns the largest estimate from n / 2 or less to n samples, n being the number at the last
  // estimate; NaN if some of them were not made.
  double sinceHalf() const;

 private:
  std::vector<RelmseCheck> last_;
};

}  // namespace restlab
