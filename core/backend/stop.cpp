#include "core/backend/stop.h"

#include <atomic>

namespace restlab {

namespace {

// Atomic instead of sig_atomic_t: written by a signal handler and read by all threads.
std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free, "as a signal handler needs");

}  // namespace

void stopFrames() noexcept { stopped.store(true, std::memory_order_relaxed); }
void resumeFrames() noexcept { stopped.store(false, std::memory_order_relaxed); }
bool framesStopped() noexcept { return stopped.load(std::memory_order_relaxed); }

}  // namespace restlab
