// Programs that are started, and what they say.
#pragma once

#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace restlab {

struct CommandResult {
  int code = -1;  // exit code, 128 + a signal, or 127 if there is no such program
  std::string out, err;
};

// Runs a program to its end, without a shell, and keeps what it writes.
CommandResult runCommand(const std::vector<std::string>& words);

// Returns the first line of a text, or "it says nothing".
std::string firstLineOf(const std::string& text);

// Returns the file of this program.
std::string ownProgram();

// Starts a program whose output goes where this one's does. Returns its process. Throws Error
// (badInput) if it cannot be started.
pid_t startProgram(const std::vector<std::string>& words,
                   const std::vector<std::string>& variables);

}  // namespace restlab
