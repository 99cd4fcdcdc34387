#include "experiments/view/prompt_end.h"

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <utility>

#include "core/backend/stop.h"
#include "core/base/error.h"
#include "core/image/io/atomic_file.h"

namespace restlab {

namespace {

constexpr std::chrono::milliseconds kInterval{20};

// Returns true if a stop is requested within `time`.
bool isStoppedWithin(const std::stop_token& stop, std::chrono::milliseconds time) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  return wake.wait_for(lock, stop, time, [&] { return stop.stop_requested(); });
}

// Bypasses the stream's buffer, whose lock another thread may hold. Writes nothing if stderr would
// block.
void sayAtEnd(const std::string& line) {
  pollfd out = {STDERR_FILENO, POLLOUT, 0};
  if (line.empty() || poll(&out, 1, 0) != 1) return;
  const std::string text = line + "\n";
  if (write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // the process ends anyway
}

// Drivers keep threads of the lowest priority, and the process is gone only when they are: seconds
// on a busy machine. Without the right to raise them this wait remains.
void raiseThreads() {
  std::error_code error;
  const int own = getpriority(PRIO_PROCESS, 0);
  std::filesystem::directory_iterator threads("/proc/self/task", error), end;
  for (; !error && threads != end; threads.increment(error))
    setpriority(PRIO_PROCESS, id_t(std::atoi(threads->path().filename().c_str())), own);
}

}  // namespace

PromptEnd::PromptEnd(std::string line, std::chrono::milliseconds patience)
    : thread_([this, line = std::move(line), patience](const std::stop_token& stop) {
        while (!framesStopped()) {
          if (isStoppedWithin(stop, kInterval)) return;
        }
        if (isStoppedWithin(stop, patience)) return;
        removeTemporaryFiles();
        if (!isSaid_) sayAtEnd(line);
        raiseThreads();
        _exit(int(ExitCode::interrupted));
      }) {}

}  // namespace restlab
