// How long the rest of a suite takes.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "experiments/runner/run/log.h"

namespace restlab {

// Runs of all tables, whoever made them, and what those that were made here took. `cost` is that of
// one run in any unit, the same for all tables: a run of four times the pixels is to take four
// times as long.
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
  // `seconds`: since the run before it ended, or since its making began.
  void made(double seconds, double cost) {
    found(cost);
    costMade_ += cost;
    seconds_ += seconds;
  }
  // As if none of the others were there: what is found by then takes no time.
  WholeProgress progress() const {
    const double perCostS = costMade_ > 0.0 ? seconds_ / costMade_ : 0.0;
    // A damaged run is made twice.
    return {done_, runs_, perCostS * std::max(cost_ - costDone_, 0.0)};
  }

 private:
  uint64_t runs_ = 0, done_ = 0;
  double cost_ = 0.0, costDone_ = 0.0, costMade_ = 0.0, seconds_ = 0.0;
};

class Stopwatch {
 public:
  // Seconds since the last lap, or since this was made.
  double lap() {
    const auto before = std::exchange(start_, std::chrono::steady_clock::now());
    return std::chrono::duration<double>(start_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace restlab
