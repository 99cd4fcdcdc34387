// Test fixture that runs the built program like a user, in its own folder.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace restlab::cli_test {

struct ProgramResult {
  int code = -1;  // exit code, or 128 + the signal that ended the program
  std::string out, err;
  uint64_t peakBytes = 0;  // largest resident memory
  // Returns lines of stderr that start with "error: ".
  std::vector<std::string> errors() const;
};

// Signals and limits for the program.
struct Circumstances {
  int signal = SIGINT;
  // Sends the signal when this returns true and the program handles it. Empty: no signal.
  std::function<bool()> signalWhen;
  uint64_t maxFileBytes = 0;  // > 0: maximum size of files (RLIMIT_FSIZE)
  double maxCpuS = 0.0;       // > 0: CPU time after which a signal ends the program (RLIMIT_CPU)
};

// Provides a temporary folder that is working directory, cache and output folder.
class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Runs `restlab arguments...`. Several calls may run at once.
  ProgramResult run(const std::vector<std::string>& arguments,
                    const Circumstances& circumstances = {}) const;
  // Splits `arguments` at blanks.
  ProgramResult run(const std::string& arguments, const Circumstances& circumstances = {}) const;
  // Runs until `when` returns true, then sends SIGINT.
  ProgramResult runUntil(const std::function<bool()>& when, const std::string& arguments) const;
  // Redirects stdout to `file`, which is not read back.
  ProgramResult runInto(const std::string& file, const std::string& arguments) const;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  // Returns whether any program of this test has written `words` to stderr by now.
  bool isSaid(const std::string& words) const;
  // Returns files and folders in the folder `name`, without hidden ones; none if the folder does
  // not exist.
  std::vector<std::filesystem::path> entries(const std::string& name) const;

  std::filesystem::path folder_;

 private:
  ProgramResult start(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                      const Circumstances& circumstances) const;
};

// RAII: sets an environment variable that the program inherits.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Variable() { old_.empty() ? unsetenv(name_) : setenv(name_, old_.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string old_;
};

// Expects an exit code and one error line with all fragments.
void expectError(const ProgramResult& result, int code, const std::vector<std::string>& fragments);

// Returns the rows of a CSV file by column name.
std::vector<std::map<std::string, std::string>> parseCsv(const std::string& text);

// Returns a glTF file of one triangle and one camera; `positions`: normally nine floats.
std::string triangleGltf(const std::vector<float>& positions,
                         const std::string& extraMaterial = "");

}  // namespace restlab::cli_test
