#include "core/backend/stop.h"

#include <atomic>

namespace restlab {

namespace {

// Written by a signal handler, read by all threads: no sig_atomic_t.
std::atomic<bool> stopped = false;
static_assert(std::atomic<bool>::is_always_lock_free, "as a signal handler needs");

}  // namespace

void stopFrames() noexcept { stopped.store(true, std::memory_order_relaxed); }
bool framesStopped() noexcept { return stopped.load(std::memory_order_relaxed); }

}  // namespace restlab
