#include "experiments/runner/cluster/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/base/error.h"

extern char** environ;

namespace restlab {

namespace {

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

int statusOf(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// File without a name, for the output of a program.
using TemporaryFile = std::unique_ptr<FILE, int (*)(FILE*)>;

std::string contentsOf(FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[4096];
  for (size_t count = 0; (count = std::fread(buffer, 1, sizeof(buffer), file)) > 0;)
    text.append(buffer, count);
  return text;
}

}  // namespace

CommandResult runCommand(const std::vector<std::string>& words) {
  const TemporaryFile out(std::tmpfile(), std::fclose), err(std::tmpfile(), std::fclose);
  if (!out || !err) failInput(fmt::format("TMPDIR: no file can be made: {}", std::strerror(errno)));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, fileno(err.get()), STDERR_FILENO);
  pid_t child = 0;
  const int status =
      posix_spawnp(&child, words[0].c_str(), &files, nullptr, pointers(words).data(), environ);
  posix_spawn_file_actions_destroy(&files);
  CommandResult result;
  if (status != 0) {
    result.code = 127;
    result.err = std::strerror(status);
    return result;
  }
  result.code = statusOf(child);
  result.out = contentsOf(out.get());
  result.err = contentsOf(err.get());
  return result;
}

std::string firstLineOf(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it says nothing" : line;
}

std::string ownProgram() {
  std::error_code status;
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", status);
  return status ? "restlab" : file.string();
}

pid_t startProgram(const std::vector<std::string>& words,
                   const std::vector<std::string>& variables) {
  std::vector<std::string> environment = variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    environment.emplace_back(*variable);
  pid_t child = 0;
  const int status = posix_spawnp(&child, words[0].c_str(), nullptr, nullptr,
                                  pointers(words).data(), pointers(environment).data());
  if (status != 0)
    failInput(fmt::format("{}: cannot be started: {}", words[0], std::strerror(status)));
  return child;
}

}  // namespace restlab
