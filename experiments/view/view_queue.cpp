#include "experiments/view/view_queue.h"

#include <utility>

#include "core/base/error.h"
#include "experiments/view/command.h"

namespace restlab {

namespace {

bool isChangeOfFrames(const std::string& text) {
  try {
    return changesFrames(parseViewCommand(text));
  } catch (const Error&) {
    return false;  // the error is reported when the command is run
  }
}

}  // namespace

void PageEvents::add(PageEvent event) {
  const bool isChange = event.kind == PageEvent::Kind::said && isChangeOfFrames(event.text);
  {
    const std::lock_guard lock(mutex_);
    const bool isFull = events_.size() >= kMostTexts || bytes_ + event.text.size() > kMostBytes;
    if (event.kind == PageEvent::Kind::said && isFull) {
      isLost_ = true;
      return;
    }
    bytes_ += event.text.size();
    events_.push_back(std::move(event));
    if (isChange) areChanges_ = true;
  }
  there_.notify_one();
}

std::vector<PageEvent> PageEvents::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (patience.count() > 0)
    there_.wait_for(lock, patience, [this] { return !events_.empty() || isWoken_; });
  isWoken_ = false;
  bytes_ = 0;
  areChanges_ = false;
  return std::exchange(events_, {});
}

bool PageEvents::areWaiting() const {
  const std::lock_guard lock(mutex_);
  return !events_.empty();
}

bool PageEvents::takeLost() {
  const std::lock_guard lock(mutex_);
  return std::exchange(isLost_, false);
}

void PageEvents::wake() {
  {
    const std::lock_guard lock(mutex_);
    isWoken_ = true;
  }
  there_.notify_one();
}

}  // namespace restlab
