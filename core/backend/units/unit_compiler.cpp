#include "core/backend/units/unit_compiler.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>

#include "unit_compiler_options.h"

extern char** environ;

namespace restlab {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

// The compiler's first error, else its last line; without the folder of the sources.
std::string reasonIn(const fs::path& log, const fs::path& folder) {
  std::ifstream stream(log);
  std::string first, last;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    last = line;
    if (first.empty() && line.find("error:") != std::string::npos) first = line;
  }
  std::string reason = first.empty() ? last : first;
  const std::string prefix = folder.string() + "/";
  for (size_t at = reason.find(prefix); at != std::string::npos; at = reason.find(prefix))
    reason.erase(at, prefix.size());
  return reason;
}

// The environment with temporary files in `folder` and messages in English, and without what would
// give the compiler other headers or parts.
std::vector<std::string> environmentFor(const fs::path& folder) {
  static const std::array<std::string_view, 9> leftOut = {"TMPDIR=",
                                                          "LC_ALL=",
                                                          "CPATH=",
                                                          "C_INCLUDE_PATH=",
                                                          "CPLUS_INCLUDE_PATH=",
                                                          "LIBRARY_PATH=",
                                                          "COMPILER_PATH=",
                                                          "GCC_EXEC_PREFIX=",
                                                          "CCC_OVERRIDE_OPTIONS="};
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const bool isLeftOut = std::any_of(leftOut.begin(), leftOut.end(), [&](std::string_view name) {
      return text.rfind(name, 0) == 0;
    });
    if (!isLeftOut) variables.push_back(text);
  }
  variables.push_back("TMPDIR=" + folder.string());
  variables.emplace_back("LC_ALL=C");
  return variables;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Starts a program in a process group of its own, so that an interrupt from the terminal does not
// reach it. Returns 0 and the error number if there is none.
std::pair<pid_t, int> start(std::vector<std::string> arguments, const fs::path& log) {
  std::vector<std::string> variables = environmentFor(log.parent_path());
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  // A compiler may live on after a program that is killed: it must hold none of its sockets.
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int status = posix_spawn(&child, arguments[0].c_str(), &files, &attributes,
                                 pointersTo(arguments).data(), pointersTo(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return {status == 0 ? child : 0, status};
}

// Waits for a child; nullopt, and the child and its children are ended, if `isOver` returns true
// first.
std::optional<int> waitFor(pid_t child, const std::function<bool()>& isOver) {
  int status = 0;
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    // A launcher may have the program ignore its children: the system then keeps no status.
    if (ended < 0 && errno == ECHILD) return 0;
    if (ended < 0 && errno != EINTR) return std::nullopt;
    if (isOver()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(-child, SIGKILL);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return std::nullopt;
}

}  // namespace

UnitCompiler unitCompiler() {
  UnitCompiler compiler;
  const char* elsewhere = std::getenv("RESTLAB_CXX");
  compiler.program = elsewhere != nullptr && *elsewhere != 0 ? elsewhere : RESTLAB_UNIT_COMPILER;
  compiler.version = __VERSION__;
  compiler.flags = linesOf(RESTLAB_UNIT_FLAGS);
  return compiler;
}

std::string whyNotThere(const UnitCompiler& compiler) {
  if (access(compiler.program.c_str(), X_OK) == 0) return "";
  return fmt::format("{}: {}", compiler.program, std::strerror(errno));
}

std::string compileUnit(const UnitCompiler& compiler, const fs::path& includes,
                        const fs::path& source, const fs::path& output,
                        const std::function<bool()>& isStopped) {
  std::vector<std::string> arguments = {compiler.program};
  arguments.insert(arguments.end(), compiler.flags.begin(), compiler.flags.end());
  arguments.insert(arguments.end(),
                   {"-I" + includes.string(), source.string(), "-o", output.string()});
  const fs::path log = output.string() + ".log";
  const auto [child, error] = start(std::move(arguments), log);
  if (child == 0) return fmt::format("{}: {}", compiler.program, std::strerror(error));
  const auto deadline = std::chrono::steady_clock::now() + compiler.limit;
  bool isLate = false;
  const std::optional<int> status = waitFor(child, [&] {
    isLate = std::chrono::steady_clock::now() >= deadline;
    return isLate || isStopped();
  });
  if (!status && isLate) {
    return fmt::format("{}: ended after {:.3g} s without a result", compiler.program,
                       std::chrono::duration<double>(compiler.limit).count());
  }
  if (!status) return fmt::format("{}: interrupted", compiler.program);
  if (WIFSIGNALED(*status))
    return fmt::format("{}: {}", compiler.program, strsignal(WTERMSIG(*status)));
  if (WEXITSTATUS(*status) != 0) {
    const std::string reason = reasonIn(log, output.parent_path());
    return fmt::format("{}: {}", compiler.program,
                       reason.empty() ? fmt::format("exit code {}", WEXITSTATUS(*status)) : reason);
  }
  std::error_code ignored;
  return fs::exists(output, ignored) ? "" : fmt::format("{}: wrote no file", compiler.program);
}

}  // namespace restlab
