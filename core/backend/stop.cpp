#include "core/backend/stop.h"

#include <atomic>

#include "core/backend/stop_scope.h"

namespace restlab {

namespace {

// Atomic instead of sig_atomic_t: written by a signal handler and read by all threads.
std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free, "as a signal handler needs");

constinit thread_local StopFlag own = nullptr;

}  // namespace

void stopFrames() noexcept { stopped.store(true, std::memory_order_relaxed); }
void resumeFrames() noexcept { stopped.store(false, std::memory_order_relaxed); }
bool framesStopped() noexcept {
  return stopped.load(std::memory_order_relaxed) ||
         (own != nullptr && own->load(std::memory_order_relaxed));
}

StopFlag stopFlag() noexcept { return own; }
StopScope::StopScope(StopFlag flag) noexcept : before_(own) { own = flag; }
StopScope::~StopScope() { own = before_; }

}  // namespace restlab
