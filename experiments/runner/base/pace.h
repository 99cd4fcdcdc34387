// Estimates the remaining time of a suite.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "experiments/runner/base/log.h"

namespace restlab {

// Counts the runs of all tables, and the time of those rendered in this call. `cost`: of one run,
// in any unit that is the same for all tables; a run with four times the pixels is assumed to take
// four times as long.
class Pace {
 public:
  void plan(uint32_t runs, double cost) {
    runs_ += runs;
    cost_ += cost * double(runs);
  }
  void found(double cost) {
    ++done_;
    costDone_ += cost;
  }
  // `seconds`: since the previous run ended, or since rendering began.
  void made(double seconds, double cost) {
    found(cost);
    costMade_ += cost;
    seconds_ += seconds;
  }
  // Assumes that no remaining run exists already: one that is found later takes no time.
  WholeProgress progress() const {
    const double perCostS = costMade_ > 0.0 ? seconds_ / costMade_ : 0.0;
    // Keep it positive: a damaged run counts twice.
    return {done_, runs_, perCostS * std::max(cost_ - costDone_, 0.0)};
  }

 private:
  uint64_t runs_ = 0, done_ = 0;
  double cost_ = 0.0, costDone_ = 0.0, costMade_ = 0.0, seconds_ = 0.0;
};

class Stopwatch {
 public:
  // Returns seconds since the last lap, or since construction.
  double lap() {
    const auto before = std::exchange(start_, std::chrono::steady_clock::now());
    return std::chrono::duration<double>(start_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace restlab
