// Ends the viewer soon after a signal, whatever its threads are in: a driver that compiles a kernel
// for seconds hears none.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace restlab {

class PromptEnd {
 public:
  // Leaves a busy machine some of the second in which the viewer is to end.
  static constexpr std::chrono::milliseconds kPatience{700};

  // Looks for a signal (core/backend/stop.h) from here on. Unless it is destroyed within `patience`
  // of it, temporary files are removed, `line` is said on stderr ("": nothing), and the process
  // ends with ExitCode::interrupted. Files that are there are whole: each has got its name when it
  // was (core/image/atomic_file.h).
  explicit PromptEnd(std::string line, std::chrono::milliseconds patience = kPatience);
  // The line is on stderr already.
  void setSaid() { isSaid_ = true; }

 private:
  std::atomic<bool> isSaid_{false};
  std::jthread thread_;
};

}  // namespace restlab
