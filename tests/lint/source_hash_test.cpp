// Tests of cmake/source_hash.cmake: a changed source changes the hashes that include it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "tests/lint/command.h"
#include "tests/runner/temporary_folder.h"

namespace restlab::lint {

namespace {

namespace fs = std::filesystem;

class SourceHash : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    for (const char* file :
         {"core/frame/session.cpp", "core/kernels/path.h", "core/CMakeLists.txt", "core/readme.md",
          "integrators/path/path.cpp", "integrators/bdpt/bdpt.cpp",
          "integrators/restir_gi/reuse.glsl", "denoise/none/none.cpp",
          "experiments/runner/run/temporal.cpp", "experiments/runner/run/experiment.h",
          "experiments/runner/tables/table.cpp", "experiments/statistics/halves_noise.cpp",
          "tests/unit/rng_test.cpp"})
      write(file, "one");
  }
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder() / file).parent_path());
    std::ofstream(folder() / file) << text;
  }
  // Returns the hashes by name: SOURCE, REFERENCE, BDPT, MEASURING.
  std::map<std::string, std::string> hashes() const {
    const fs::path header = folder() / "source_hash.h";
    const CommandResult result =
        runCommand("cmake -D SOURCE_DIR=" + folder().string() + " -D OUTPUT=" + header.string() +
                   " -D COMPILER=x -D FLAGS=y -D BUILD_TYPE=z -P " RESTLAB_SOURCE_DIR
                   "/cmake/source_hash.cmake");
    EXPECT_EQ(result.status, 0) << result.output;
    std::ifstream in(header);
    std::ostringstream text;
    text << in.rdbuf();
    std::map<std::string, std::string> found;
    const std::string all = text.str();
    const std::regex define("RESTLAB_(\\w+)_HASH \"([0-9a-f]{16})\"");
    for (std::sregex_iterator it(all.begin(), all.end(), define), end; it != end; ++it)
      found[(*it)[1]] = (*it)[2];
    EXPECT_EQ(found.size(), 4u) << all;
    return found;
  }
  // Returns the names of the hashes that a changed text of `file` changes, such as "SOURCE
  // REFERENCE ".
  std::string changedBy(const fs::path& file) const {
    const auto before = hashes();
    write(file, "two");
    std::string changed;
    for (const auto& [name, hash] : hashes())
      if (before.at(name) != hash) changed += name + " ";
    return changed;
  }
};

TEST_F(SourceHash, IsOfTheSourcesThatDecideTheNumbers) {
  EXPECT_EQ(hashes(), hashes());
  EXPECT_EQ(changedBy("core/frame/session.cpp"), "BDPT REFERENCE SOURCE ");
  EXPECT_EQ(changedBy("core/kernels/path.h"), "BDPT REFERENCE SOURCE ");
  EXPECT_EQ(changedBy("core/CMakeLists.txt"), "BDPT REFERENCE SOURCE ");
  EXPECT_EQ(changedBy("integrators/path/path.cpp"), "REFERENCE SOURCE ");
  EXPECT_EQ(changedBy("integrators/bdpt/bdpt.cpp"), "BDPT SOURCE ");
  EXPECT_EQ(changedBy("integrators/restir_gi/reuse.glsl"), "SOURCE ");
  EXPECT_EQ(changedBy("denoise/none/none.cpp"), "SOURCE ");
  EXPECT_EQ(changedBy("experiments/runner/run/temporal.cpp"), "MEASURING ");
  EXPECT_EQ(changedBy("experiments/runner/run/experiment.h"), "MEASURING ");
  EXPECT_EQ(changedBy("experiments/statistics/halves_noise.cpp"), "MEASURING ");
  for (const char* layout :
       {"experiments/runner/tables/table.cpp", "core/readme.md", "tests/unit/rng_test.cpp"})
    EXPECT_EQ(changedBy(layout), "") << layout;
  const auto before = hashes();
  fs::rename(folder() / "core/frame/session.cpp", folder() / "core/sessions.cpp");
  EXPECT_NE(hashes().at("SOURCE"), before.at("SOURCE")) << "names count";
}

// New suites and notes of a user do not make a commit dirty; changed files and new sources do.
TEST_F(SourceHash, DirtyAreChangesAndNewSources) {
  const auto isDirty = [&] {
    hashes();
    std::ifstream in(folder() / "source_hash.h");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str().find("#define RESTLAB_GIT_DIRTY 1") != std::string::npos;
  };
  const std::string git = "env -u GIT_DIR -u GIT_WORK_TREE -u GIT_INDEX_FILE git -C " +
                          folder().string() +
                          " -c user.name=x -c user.email=x -c commit.gpgsign=false ";
  const CommandResult made =
      runCommand(git + "init -q && " + git + "add . && " + git + "commit -q -m one");
  ASSERT_EQ(made.status, 0) << made.output;
  EXPECT_FALSE(isDirty());
  write("mine.toml", "one");
  write("experiments/suites/mine.toml", "one");
  EXPECT_FALSE(isDirty());
  write("core/new.glsl", "one");
  EXPECT_TRUE(isDirty());
  fs::remove(folder() / "core/new.glsl");
  write("experiments/runner/new.cpp", "one");
  EXPECT_TRUE(isDirty());
  fs::remove(folder() / "experiments/runner/new.cpp");
  EXPECT_FALSE(isDirty());
  write("core/readme.md", "two");
  EXPECT_TRUE(isDirty());
}

// A renamed file must not silently drop out of the hash.
TEST(MeasuringSources, AreAllThere) {
  std::ifstream in(RESTLAB_SOURCE_DIR "/cmake/source_hash.cmake");
  std::ostringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  std::smatch list;
  ASSERT_TRUE(std::regex_search(all, list, std::regex("set\\(measuring ([^)]*)\\)")));
  std::istringstream names(list[1].str());
  size_t count = 0;
  for (std::string name; names >> name; ++count)
    EXPECT_TRUE(fs::exists(fs::path(RESTLAB_SOURCE_DIR "/experiments") / (name + ".cpp"))) << name;
  EXPECT_GE(count, 8u);
}

}  // namespace

}  // namespace restlab::lint
