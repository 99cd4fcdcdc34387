// User-facing errors. Each carries the exit code of the program and one line of text: file, place,
// what is wrong, what would be right.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace restlab {

enum class ExitCode : int {
  ok = 0,
  comparisonFailed = 1,
  badUsage = 2,  // command line or configuration
  badInput = 3,  // scene, image or reference
  deviceUnavailable = 4,
  interrupted = 130,
};

// Replaces every control character of `text` by a blank: names inside files may contain line breaks
// and terminal escapes.
std::string oneLine(std::string text);

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& line) : std::runtime_error(oneLine(line)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Reports a wrong command line or configuration (exit code 2).
[[noreturn]] inline void failUsage(const std::string& line) {
  throw Error(ExitCode::badUsage, line);
}
// Reports a wrong scene, image or reference (exit code 3).
[[noreturn]] inline void failInput(const std::string& line) {
  throw Error(ExitCode::badInput, line);
}

// Runs `step`; rethrows its error with `place` ("file:line:column") in front.
template <class Step>
auto atPlace(const std::string& place, const Step& step) {
  try {
    return step();
  } catch (const Error& error) {
    throw Error(error.code(), place + ": " + error.what());
  }
}

// Returns the candidate nearest to `name` by edit distance, or "" when none is close.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

// Returns "; did you mean 'x'?" or "", to be appended to an error line.
std::string didYouMean(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace restlab
