// User-facing errors. Each carries the exit code of the program contract and one line of text:
// file, place, what is wrong, what would be right.
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

// `text` with every control character as a blank: names inside files may hold line breaks and the
// escapes of terminals.
std::string oneLine(std::string text);

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& line) : std::runtime_error(oneLine(line)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Command line or configuration is wrong (exit code 2).
[[noreturn]] inline void failUsage(const std::string& line) {
  throw Error(ExitCode::badUsage, line);
}
// A scene, image or reference is wrong (exit code 3).
[[noreturn]] inline void failInput(const std::string& line) {
  throw Error(ExitCode::badInput, line);
}

// Runs `step`; its error is said again with `place` ("file:line:column") before it.
template <class Step>
auto atPlace(const std::string& place, const Step& step) {
  try {
    return step();
  } catch (const Error& error) {
    throw Error(error.code(), place + ": " + error.what());
  }
}

// The candidate nearest to `name` by edit distance, or "" when none is close.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

// "; did you mean 'x'?" or "" - to be appended to an error line.
std::string didYouMean(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace restlab
