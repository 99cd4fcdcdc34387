// What pages have said, on its way from the server's thread to the one that renders.
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
  // Texts beyond are lost: no page types so fast. Pages that come and go never are.
  static constexpr size_t kMostTexts = 4096, kMostBytes = 4 << 20;

  // Never waits for long.
  void add(PageEvent event);
  // All there are; where there is none, after so long a time at the latest.
  std::vector<PageEvent> take(std::chrono::milliseconds patience);
  bool areWaiting() const;
  // Commands that change frames are. Asked for often.
  bool areChangesWaiting() const { return areChanges_.load(std::memory_order_relaxed); }
  // Whether texts were lost since the last call.
  bool takeLost();
  // Ends waits.
  void wake();

 private:
  mutable std::mutex mutex_;
  std::condition_variable there_;
  std::vector<PageEvent> events_;
  size_t bytes_ = 0;  // of their texts
  bool isWoken_ = false, isLost_ = false;
  std::atomic<bool> areChanges_ = false;
};

}  // namespace restlab
