#include "experiments/view/measurement.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"

extern char** environ;

namespace restlab {

namespace {

using Json = nlohmann::json;

constexpr size_t kMostLine = 1 << 20;

// What a process begins with.
class Spawn {
 public:
  Spawn() {
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
  }
  ~Spawn() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  Spawn(const Spawn&) = delete;
  Spawn& operator=(const Spawn&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

}  // namespace

Measurement::~Measurement() {
  if (!isRunning()) return;
  kill(-child_, SIGINT);  // with what it has started
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  close(pipe_);
}

void Measurement::begin(const std::filesystem::path& program, const std::filesystem::path& folder,
                        const std::string& suite, const std::string& out) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0)
    failInput(fmt::format("measure: no pipe: {}", std::strerror(errno)));
  Spawn spawn;
  posix_spawn_file_actions_addopen(&spawn.actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&spawn.actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.actions, ends[1], 2);
  // The server's connections are none of its business.
  posix_spawn_file_actions_addclosefrom_np(&spawn.actions, 3);
  posix_spawn_file_actions_addchdir_np(&spawn.actions, folder.c_str());
  // A group of its own: whoever ends the viewer by Ctrl-C ends the run once, through the viewer.
  posix_spawnattr_setflags(&spawn.attributes, POSIX_SPAWN_SETPGROUP);
  std::string words[] = {program.string(), "run", suite, "-o", out, "--json"};
  char* arguments[std::size(words) + 1] = {};
  for (size_t i = 0; i < std::size(words); ++i) arguments[i] = words[i].data();
  const int error =
      posix_spawn(&child_, arguments[0], &spawn.actions, &spawn.attributes, arguments, environ);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    failInput(fmt::format("measure: {}: {}", program.string(), std::strerror(error)));
  }
  pipe_ = ends[0];
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
}

void Measurement::cancel() {
  if (!isRunning()) failUsage("cancel: nothing is measured");
  isCancelled_ = true;
  kill(-child_, SIGINT);  // with what it has started
}

bool Measurement::poll() {
  if (!isRunning()) return false;
  const bool isNew = read();
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) != child_) return isNew;
  read();  // what it said at last
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

// A line of `run --json`.
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
