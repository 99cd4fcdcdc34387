#include "experiments/runner/run/interrupt.h"

#include <atomic>
#include <csignal>
#include <string>

#include "core/error.h"

namespace restlab {

namespace {

// Read by the threads of `-j` while a handler on another one writes: no sig_atomic_t.
std::atomic<bool> signalSeen = false;
static_assert(std::atomic<bool>::is_always_lock_free, "as a signal handler needs");

void onSignal(int) { signalSeen.store(true, std::memory_order_relaxed); }

}  // namespace

void installInterruptHandler() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second signal has its default effect
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A limit on the size of files is an error of the write that meets it, not the program's end.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interruptRequested() { return signalSeen.load(std::memory_order_relaxed); }

void throwIfInterrupted(const char* what) {
  if (interruptRequested()) throw Error(ExitCode::interrupted, std::string("interrupted: ") + what);
}

}  // namespace restlab
