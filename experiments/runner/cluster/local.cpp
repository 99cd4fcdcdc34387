// Processes on this machine.
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <map>
#include <thread>

#include "core/base/error.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/cluster/command.h"
#include "experiments/runner/cluster/engine.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

class Local : public Engine {
 public:
  Local(const fs::path& folder, uint32_t processes) : folder_(folder), processes_(processes) {}

  std::vector<std::vector<uint64_t>> parts(const std::vector<uint64_t>& tasks) const override {
    return {tasks};
  }

  std::string launch(const std::vector<uint64_t>& tasks, const Asked&) override {
    Progress progress("tasks", tasks.size());
    size_t next = 0;
    uint64_t ended = 0;
    while ((next < tasks.size() && !interruptRequested()) || !atWork_.empty()) {
      while (atWork_.size() < processes_ && next < tasks.size() && !interruptRequested())
        start(tasks[next++]);
      if (interruptRequested()) {
        // A second signal would end them at once.
        for (auto& [process, task] : atWork_)
          if (!std::exchange(task.isStopped, true)) kill(process, SIGTERM);
      }
      if (waitForOne()) {
        progress.update(++ended);
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    }
    progress.finish();
    throwIfInterrupted("finished tasks are kept; the same command goes on");
    return "";
  }

  std::string goOn(const Asked&, const std::vector<std::string>&) override { return ""; }
  bool hasJobs() const override { return false; }

 private:
  struct AtWork {
    uint64_t index;
    bool isStopped = false;
  };

  void start(uint64_t index) {
    const pid_t process = startProgram(
        {ownProgram(), "work", folder_.string(), "--index", std::to_string(index), "-q"}, {});
    atWork_.emplace(process, AtWork{index});
  }

  // Returns whether a process has ended.
  bool waitForOne() {
    int status = 0;
    for (auto one = atWork_.begin(); one != atWork_.end(); ++one) {
      const pid_t ended = waitpid(one->first, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) continue;
      atWork_.erase(one);
      return true;
    }
    return false;
  }

  fs::path folder_;
  size_t processes_;
  std::map<pid_t, AtWork> atWork_;
};

}  // namespace

std::unique_ptr<Engine> makeLocal(const fs::path& folder, uint32_t processes) {
  return std::make_unique<Local>(folder, processes);
}

}  // namespace restlab
