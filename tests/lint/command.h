// Runs a shell command and returns its exit status and output.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace restlab::lint {

struct CommandResult {
  int status;
  std::string output;
};

inline CommandResult runCommand(const std::string& command) {
  CommandResult result{-1, ""};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  char buffer[4096];
  for (size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.output.append(buffer, n);
  const int status = pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return result;
}

}  // namespace restlab::lint
