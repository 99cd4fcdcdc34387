// Runs the built program as a user would, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace restlab::cli_test {

struct ProgramResult {
  int code = -1;  // exit code; 128 + the signal that ended it
  std::string out, err;
  uint64_t peakBytes = 0;  // largest resident memory
  // Lines of stderr that start with "error: ".
  std::vector<std::string> errors() const;
};

// What happens to the program while it runs.
struct Circumstances {
  int signal = SIGINT;
  // As soon as this holds and the program handles the signal. None: no signal.
  std::function<bool()> signalWhen;
  uint64_t maxFileBytes = 0;  // > 0: no file may grow beyond (RLIMIT_FSIZE)
  double maxCpuS = 0.0;       // > 0: more time ends the program by a signal (RLIMIT_CPU)
};

// A temporary folder that is the working directory, the cache and the place of outputs.
class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Runs `restlab arguments...`. Several may run at once.
  ProgramResult run(const std::vector<std::string>& arguments,
                    const Circumstances& circumstances = {}) const;
  // The same with one string, split at blanks.
  ProgramResult run(const std::string& arguments, const Circumstances& circumstances = {}) const;
  // The same until `when` holds, which SIGINT follows.
  ProgramResult runUntil(const std::function<bool()>& when, const std::string& arguments) const;
  // The same with stdout going to `file`, which is not read back.
  ProgramResult runInto(const std::string& file, const std::string& arguments) const;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  // On stderr by now, by any program of this test.
  bool isSaid(const std::string& words) const;
  // Files and folders in the folder `name`, hidden ones left out; none where there is no such
  // folder.
  std::vector<std::filesystem::path> entries(const std::string& name) const;

  std::filesystem::path folder_;

 private:
  ProgramResult start(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                      const Circumstances& circumstances) const;
};

// Expects an exit code and one error line that holds every one of the fragments.
void expectError(const ProgramResult& result, int code, const std::vector<std::string>& fragments);

// Rows of a CSV file by column name.
std::vector<std::map<std::string, std::string>> parseCsv(const std::string& text);

// A glTF file of one triangle and one camera; positions are nine floats, or as many as are given.
std::string triangleGltf(const std::vector<float>& positions,
                         const std::string& extraMaterial = "");

}  // namespace restlab::cli_test
