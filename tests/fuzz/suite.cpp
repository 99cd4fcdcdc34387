#include "experiments/runner/suite/suite.h"

#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {

bool readSuite(const uint8_t* bytes, size_t count) {
  const std::filesystem::path file = inputFile("suite.toml", bytes, count);
  return isRead(file, ExitCode::badUsage, [&] { loadSuites(file, {}, {}); });
}

}  // namespace restlab::fuzz
