// Checks that every source file is formatted by clang-format 16; other versions differ in places.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/lint/command.h"

namespace restlab::lint {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> sourceFiles() {
  std::vector<std::string> files;
  for (const char* folder : {"core", "integrators", "denoise", "experiments", "tests"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RESTLAB_SOURCE_DIR) / folder)) {
      const fs::path& path = entry.path();
      if (path.parent_path().filename() == "data") continue;  // broken on purpose
      for (const char* extension : {".cpp", ".h", ".inl", ".glsl"}) {
        if (path.extension() == extension)
          files.push_back(fs::relative(path, RESTLAB_SOURCE_DIR).string());
      }
    }
  }
  return files;
}

TEST(Format, EveryFileIsFormatted) {
  if (std::string(RESTLAB_CLANG_FORMAT).find("NOTFOUND") != std::string::npos) {
    GTEST_SKIP() << "clang-format 16 is not installed";
  }
  const std::vector<std::string> files = sourceFiles();
  EXPECT_GT(files.size(), 100u);
  std::string names;
  for (const std::string& file : files) names += " '" + file + "'";
  // The dialect's files are formatted as C++, which clang-format takes unknown endings for.
  const CommandResult result = runCommand(
      "cd '" RESTLAB_SOURCE_DIR "' && " RESTLAB_CLANG_FORMAT " --dry-run --Werror" + names);
  EXPECT_EQ(result.status, 0) << result.output;
}

}  // namespace
}  // namespace restlab::lint
