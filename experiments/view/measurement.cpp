#include "experiments/view/measurement.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "core/base/error.h"

extern char** environ;

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

using Clock = std::chrono::steady_clock;

constexpr size_t kMostLine = 1 << 20;
// Time for the run to store its results; the viewer's own end waits for it (prompt_end.h).
constexpr std::chrono::milliseconds kPatience{400};

// Runs between fork() and exec(): only async-signal-safe calls are allowed. Writes errno to
// `failure` on an error.
[[noreturn]] void becomeProgram(char* const* arguments, const char* folder, int output, int failure,
                                pid_t viewer) {
  // Ends the run with the viewer, however that ends; the run keeps its finished results.
  const bool isTied = prctl(PR_SET_PDEATHSIG, SIGINT) == 0 && getppid() == viewer;
  // A shell's background jobs ignore SIGINT, and their children would inherit that.
  signal(SIGINT, SIG_DFL);
  // Own process group: Ctrl-C in the viewer must reach the run once, through the viewer.
  const bool isReady = isTied && setpgid(0, 0) == 0 && chdir(folder) == 0;
  const int in = open("/dev/null", O_RDONLY), out = open("/dev/null", O_WRONLY);
  if (isReady && dup2(in, 0) == 0 && dup2(out, 1) == 1 && dup2(output, 2) == 2) {
    // Close the server's connections in the new program.
    if (close_range(3, ~0u, CLOSE_RANGE_CLOEXEC) == 0) execve(arguments[0], arguments, environ);
  }
  const int error = errno;
  if (write(failure, &error, sizeof error) != sizeof error) _exit(126);
  _exit(127);
}

// RAII: pipe with both ends. Throws Error (badInput) if it cannot be made.
struct Pipe {
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0)
      failInput(fmt::format("measure: no pipe: {}", std::strerror(errno)));
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void closeWriting() { close(std::exchange(ends[1], -1)); }

  int ends[2] = {-1, -1};
};

}  // namespace

// Sends SIGINT twice, then SIGKILL. The first signal may be missed while a driver compiles a
// kernel; the second one has its default effect (experiments/runner/base/interrupt.h).
Measurement::~Measurement() {
  if (!isRunning()) return;
  pid_t ended = 0;
  for (const int signal : {SIGINT, SIGINT, SIGKILL}) {
    kill(-child_, signal);  // the whole process group
    for (const auto start = Clock::now(); ended == 0 && Clock::now() - start < kPatience;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      int status = 0;
      ended = waitpid(child_, &status, WNOHANG);
    }
    if (ended != 0) break;
  }
  close(pipe_);
}

void Measurement::begin(const std::filesystem::path& program, const std::filesystem::path& folder,
                        const std::string& suite, const std::string& out) {
  std::string words[] = {program.string(), "run", suite, "-o", out, "--json"};
  char* arguments[std::size(words) + 1] = {};
  for (size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
  Pipe output, failure;
  const pid_t viewer = getpid();
  child_ = fork();
  if (child_ == 0)
    becomeProgram(arguments, folder.c_str(), output.ends[1], failure.ends[1], viewer);
  int error = child_ < 0 ? errno : 0;
  output.closeWriting();
  failure.closeWriting();
  // Nothing is read if the program has started: exec() closes the pipe.
  if (child_ > 0 && ::read(failure.ends[0], &error, sizeof error) == sizeof error) {
    int status = 0;
    waitpid(child_, &status, 0);
  }
  if (error != 0) failInput(fmt::format("measure: {}: {}", program.string(), std::strerror(error)));
  pipe_ = std::exchange(output.ends[0], -1);
  fcntl(pipe_, F_SETFL, O_NONBLOCK);
  state_ = State::running;
  isCancelled_ = false;
  folder_ = folder;
  suite_ = suite;
  out_ = out;
  text_ = "begins";
  rest_.clear();
  error_.clear();
  done_ = 0.0;
  rows_.follow(folder_ / out_ / "results.jsonl");
}

void Measurement::cancel() {
  if (!isRunning()) failUsage("cancel: nothing is measured");
  isCancelled_ = true;
  kill(-child_, SIGINT);  // the whole process group
}

bool Measurement::poll() {
  if (!isRunning()) return false;
  const bool isRead = read();
  const bool isNew = rows_.poll() || isRead;
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) != child_) return isNew;
  read();  // the rest of its output
  rows_.poll();
  close(pipe_);
  end(status);
  return true;
}

bool Measurement::read() {
  bool isNew = false;
  char buffer[4096];
  for (ssize_t count = 0; (count = ::read(pipe_, buffer, sizeof buffer)) > 0;) {
    rest_.append(buffer, size_t(count));
    for (size_t at = 0; (at = rest_.find('\n')) != std::string::npos; isNew = true) {
      hear(rest_.substr(0, at));
      rest_.erase(0, at + 1);
    }
    if (rest_.size() > kMostLine) rest_.clear();
  }
  return isNew;
}

// Reads a line of `run --json`.
void Measurement::hear(const std::string& line) {
  const Json event = Json::parse(line, nullptr, false);
  if (!event.is_object()) return;
  const std::string kind = event.value("event", "");
  if (kind == "error") error_ = event.value("text", "");
  if (kind == "info" || kind == "warning" || kind == "error") text_ = event.value("text", "");
  if (kind != "progress") return;
  const double total = event.value("suite_total", event.value("total", 0.0));
  const double done = event.value("suite_done", event.value("done", 0.0));
  text_ = event.value("of", "");
  if (total > 0.0) text_ += fmt::format(" {:.0f} of {:.0f}", done, total);
  const double left = event.value("suite_left_s", event.value("left_s", 0.0));
  if (left > 0.0) text_ += fmt::format(", {:.0f} s left", left);
  if (event.contains("suite_total") && total > 0.0) done_ = std::clamp(done / total, 0.0, 1.0);
}

void Measurement::end(int status) {
  const bool isDone = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  state_ = isDone ? State::finished : isCancelled_ ? State::cancelled : State::failed;
  if (isDone) {
    done_ = 1.0;
    text_ = "finished";
  } else if (isCancelled_) {
    text_ = fmt::format("./lab run {} -o {} goes on", suite_, out_);
  } else if (!error_.empty()) {
    text_ = error_;
  } else {
    text_ = WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                : fmt::format("ended with code {}", WEXITSTATUS(status));
  }
}

}  // namespace restlab
