// Ends the work of one call, on whichever threads it is done. stopFrames() ends that of all calls.
#pragma once

#include <atomic>

namespace restlab {

// Set: the work is to end. nullptr: stopFrames() alone ends it.
using StopFlag = const std::atomic<bool>*;

// Flag that this thread works under. Who starts threads gives it to a StopScope of each.
StopFlag stopFlag() noexcept;

// RAII: framesStopped() of this thread is true while `flag` is set, too.
class StopScope {
 public:
  explicit StopScope(StopFlag flag) noexcept;
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  StopFlag before_;
};

}  // namespace restlab
