#include "experiments/runner/base/interrupt.h"

#include <csignal>
#include <string>

#include "core/backend/stop.h"
#include "core/base/error.h"

namespace restlab {

namespace {

void onSignal(int) { stopFrames(); }

}  // namespace

void installInterruptHandler() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second signal has its default effect
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // SIGHUP means that the terminal is gone. Keep it ignored under `nohup`.
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  // Turns exceeding the file size limit into a write error instead of the program's end.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interruptRequested() { return framesStopped(); }

void throwIfInterrupted(const char* what) {
  if (interruptRequested()) throw Error(ExitCode::interrupted, std::string("interrupted: ") + what);
}

}  // namespace restlab
