// Fixture for programs that render references, with comparisons of references.
#pragma once

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

class ReferenceFilesTest : public ProgramTest {
 protected:
  // Returns stored progress files, sorted by name.
  std::vector<std::filesystem::path> states() const;
  // Returns samples per pixel of the only state; 0 if there is none.
  uint64_t keptSpp() const;
  // Expects two files to hold the same reference, except for times.
  void expectSame(const std::string& a, const std::string& b) const;
  // Expects `file` to equal the result of one call with `options` without stored progress.
  void expectInOneGo(const std::string& file, const std::string& options) const;
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace restlab::cli_test
