// A program that makes references, and what tells whether two of them are the same.
#pragma once

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {

class ReferenceFilesTest : public ProgramTest {
 protected:
  // Stored progress, in the order of their names.
  std::vector<std::filesystem::path> states() const;
  // Samples per pixel that its only state has; 0 where there is none.
  uint64_t keptSpp() const;
  // Expects two files to hold the same reference, whatever time they took.
  void expectSame(const std::string& a, const std::string& b) const;
  // Expects `file` to be what one call without stored progress makes of `options`.
  void expectInOneGo(const std::string& file, const std::string& options) const;
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace restlab::cli_test
