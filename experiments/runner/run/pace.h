// How long the rest of a suite takes.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "experiments/runner/run/log.h"

namespace restlab {

// Runs of all tables, whoever made them, and what those that were made here took.
class Pace {
 public:
  void plan(uint32_t runs) { runs_ += runs; }
  void found() { ++done_; }
  // `seconds`: since the run before it ended, or since its making began.
  void made(double seconds) {
    ++done_;
    ++made_;
    seconds_ += seconds;
  }
  // As if none of the others were there: what is found by then takes no time.
  WholeProgress progress() const {
    const double runS = made_ > 0 ? seconds_ / double(made_) : 0.0;
    // A damaged run is made twice.
    return {done_, runs_, runS * double(runs_ - std::min(done_, runs_))};
  }

 private:
  uint64_t runs_ = 0, done_ = 0, made_ = 0;
  double seconds_ = 0.0;
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
