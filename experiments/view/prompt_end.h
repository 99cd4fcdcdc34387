// Ends the viewer soon after a signal, even if its threads cannot react, such as in a driver that
// compiles a kernel for seconds.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace restlab {

class PromptEnd {
 public:
  // Time after a signal for an orderly end: leaves a busy machine some of the second in which the
  // viewer must be gone.
  static constexpr std::chrono::milliseconds kPatience{700};

  // Watches for a signal (core/backend/stop.h). Unless destroyed within `patience` of it, removes
  // temporary files, writes `line` to stderr ("": nothing) and ends the process with
  // ExitCode::interrupted. Files that exist are complete: each got its name only when it was
  // (core/image/io/atomic_file.h).
  explicit PromptEnd(std::string line, std::chrono::milliseconds patience = kPatience);
  // Suppresses the line: it is on stderr already.
  void setSaid() { isSaid_ = true; }

 private:
  std::atomic<bool> isSaid_{false};
  std::jthread thread_;
};

}  // namespace restlab
