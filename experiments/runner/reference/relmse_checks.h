// When a reference has samples enough for a target error. Its estimate is noisy, and too low as
// long as no sample has found a rare bright path: the first one below the target would stop too
// early. So estimates are made at fixed numbers of samples, and all since half of them must agree.
#pragma once

#include <cstdint>
#include <vector>

namespace restlab {

class RelmseChecks {
 public:
  // Below this many samples the two halves say too little about their own error.
  static constexpr uint64_t kFirstSpp = 16;

  RelmseChecks() = default;
  // Those that were kept of an earlier call.
  explicit RelmseChecks(std::vector<double> kept) : last_(std::move(kept)) {}

  // Four times for each doubling: 16, 20, 24, 28, 32, 40, 48, ... samples. Nowhere else, so that a
  // rendering that was interrupted stops where it would have stopped.
  static bool isDue(uint64_t spp);
  void add(double relmse);
  // What later decisions need: the last estimates, the newest last.
  const std::vector<double>& kept() const { return last_; }
  // The largest of the estimates from n / 2 to n samples, n those of the last; NaN where some of
  // them were not made.
  double sinceHalf() const;

 private:
  std::vector<double> last_;
};

}  // namespace restlab
