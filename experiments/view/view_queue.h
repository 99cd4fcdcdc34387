// Queue of page events, from the server's thread to the rendering thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "experiments/view/server.h"

namespace restlab {

struct PageEvent {
  enum class Kind { opened, closed, said } kind = Kind::said;
  ClientId client = 0;
  std::string text;
};

class PageEvents {
 public:
  // Limits of queued texts; further texts are lost, as no page sends so fast. Opened and closed
  // events are never lost.
  static constexpr size_t kMostTexts = 4096, kMostBytes = 4 << 20;

  // Never blocks for long.
  void add(PageEvent event);
  // Returns all events; waits for the first one at most `patience`.
  std::vector<PageEvent> take(std::chrono::milliseconds patience);
  bool areWaiting() const;
  // True if commands that change frames are waiting. Cheap: called often during a frame.
  bool areChangesWaiting() const { return areChanges_.load(std::memory_order_relaxed); }
  // Returns whether texts were lost since the last call.
  bool takeLost();
  // Ends a wait in take().
  void wake();

 private:
  mutable std::mutex mutex_;
  std::condition_variable there_;
  std::vector<PageEvent> events_;
  size_t bytes_ = 0;  // bytes of queued texts
  bool isWoken_ = false, isLost_ = false;
  std::atomic<bool> areChanges_ = false;
};

}  // namespace restlab
