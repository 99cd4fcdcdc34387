// The folders of experiments/ and of experiments/runner/ are read in one direction.
#include "tests/lint/folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace restlab::lint {
namespace {

namespace fs = std::filesystem;

std::vector<SourceText> sources() {
  std::vector<SourceText> all;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(RESTLAB_SOURCE_DIR) / "experiments")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    all.push_back({fs::relative(entry.path(), RESTLAB_SOURCE_DIR).generic_string(), text.str()});
  }
  return all;
}

SourceText file(const std::string& path, const std::string& included) {
  return {path, "// A file.\n#pragma once\n\n#include \"" + included + "\"\n"};
}

TEST(Folders, OfExperimentsFormNoCycle) {
  const std::vector<SourceText> files = sources();
  for (const char* root : {"experiments/", "experiments/runner/"}) {
    const FolderIncludes includes = folderIncludes(root, files);
    EXPECT_GT(includes.size(), 2u) << root << ": the test reads nothing";
    EXPECT_EQ(folderCycle(includes), "") << root;
  }
}

TEST(Folders, ACycleIsFound) {
  const SourceText up = file("a/x/one.h", "a/y/two.h"), on = file("a/y/deep/two.h", "a/z/three.h");
  EXPECT_EQ(folderCycle(folderIncludes("a/", {up, on})), "");
  EXPECT_EQ(folderCycle(folderIncludes("a/", {up, on, file("a/z/three.cpp", "a/x/one.h")})),
            "a/x -> a/y by a/x/one.h\na/y -> a/z by a/y/deep/two.h\na/z -> a/x by a/z/three.cpp\n");
  EXPECT_EQ(folderCycle(folderIncludes(
                "a/", {up, file("a/x/two.h", "a/x/one.h"), file("a/y/two.h", "b/x/one.h")})),
            "");
}

}  // namespace
}  // namespace restlab::lint
