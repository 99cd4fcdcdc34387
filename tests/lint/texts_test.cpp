// Rules of comments and documents on snippets, then on every file of the repository.
#include "tests/lint/texts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/lint/std_headers.h"

namespace restlab::lint {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string nameOf(const fs::path& file) {
  return fs::relative(file, RESTLAB_SOURCE_DIR).generic_string();
}

const std::vector<std::string> kFolders = {"core",  "integrators", "denoise", "experiments",
                                           "tests", "docs",        "cmake"};

// Returns files of the repository's folders and of its root.
std::vector<fs::path> allFiles() {
  std::vector<fs::path> files;
  for (const std::string& folder : kFolders) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RESTLAB_SOURCE_DIR) / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  for (const auto& entry : fs::directory_iterator(RESTLAB_SOURCE_DIR))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}

bool isOneOf(const fs::path& file, const std::set<std::string>& extensions) {
  return extensions.contains(file.extension().string());
}

TEST(Riddles, AreFoundWhereACommentBegins) {
  EXPECT_EQ(findRiddles("a.h", "// Of the scene.\nint a;\n").size(), 1u);
  EXPECT_EQ(findRiddles("a.h", "int a;  // What is left.\n").size(), 1u);
  EXPECT_TRUE(findRiddles("a.h", "// Returns the share\n// Of nothing.\n").empty()) << "goes on";
  EXPECT_TRUE(findRiddles("a.h", "// Offset in bytes.\n").empty());
}

TEST(LongSentences, AreFoundInParagraphsAlone) {
  const std::string ten = "one two three four five six seven eight nine ten ";
  EXPECT_EQ(findLongSentences("a.md", "\n" + ten + "\n" + ten + "eleven.\n", 20).size(), 1u);
  EXPECT_EQ(findLongSentences("a.md", "\n" + ten + "\n" + ten + "eleven.\n", 20)[0].line, 2);
  EXPECT_TRUE(findLongSentences("a.md", ten + "end. And " + ten + "\n", 11).empty());
  EXPECT_TRUE(findLongSentences("a.md", "- " + ten + "\n- " + ten + "\n", 10).empty());
  EXPECT_TRUE(findLongSentences("a.md", "| " + ten + ten + "|\n\n    " + ten + ten, 10).empty());
}

TEST(MissingPaths, AreThoseThatNoFileHas) {
  const std::set<std::string> paths = {"core/a", "core/a/b.glsl", "tests/c.cpp"};
  EXPECT_TRUE(findMissingPaths("a.md", "(core/a/b.glsl), core/a/b and `core/a`.", paths).empty());
  EXPECT_TRUE(findMissingPaths("a.md", "tests/c_*.cpp, build/core/x", paths).empty());
  const auto found = findMissingPaths("a.md", "\nSee core/a/d.glsl.", paths);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 2);
}

TEST(StdHeaders, AreThoseOfTheCalls) {
  const std::string call = "\nint a = std::max({1, 2});\n";
  const auto found = findMissingStdHeaders("a.cpp", "#include <numeric>\n" + call);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 3);
  EXPECT_TRUE(findMissingStdHeaders("a.cpp", "#include <algorithm>\n" + call).empty());
  EXPECT_EQ(findMissingStdHeaders("a.cpp", "std::iota(a, b, 0);").size(), 1u);
  EXPECT_TRUE(findMissingStdHeaders("a.cpp", "std::maximal(1); my::max(1, 2);").empty());
}

TEST(Texts, CommentsBeginWithWhatTheyAreAbout) {
  size_t files = 0;
  for (const fs::path& file : allFiles()) {
    if (!isOneOf(file, {".h", ".cpp", ".inl", ".glsl", ".js"})) continue;
    if (file.filename() == "texts_test.cpp") continue;  // makes some up
    ++files;
    const std::vector<Finding> found = findRiddles(nameOf(file), textOf(file));
    EXPECT_TRUE(found.empty()) << format(found);
  }
  EXPECT_GT(files, 500u);
}

TEST(Texts, FilesIncludeTheAlgorithmsThatTheyCall) {
  size_t files = 0;
  for (const fs::path& file : allFiles()) {
    if (!isOneOf(file, {".h", ".cpp"}) || file.filename() == "texts_test.cpp") continue;
    ++files;
    const std::vector<Finding> found = findMissingStdHeaders(nameOf(file), textOf(file));
    EXPECT_TRUE(found.empty()) << format(found);
  }
  EXPECT_GT(files, 500u);
}

TEST(Texts, SentencesOfDocumentsAreShort) {
  for (const fs::path& file : allFiles()) {
    if (file.extension() != ".md") continue;
    const std::vector<Finding> found = findLongSentences(nameOf(file), textOf(file));
    EXPECT_TRUE(found.empty()) << format(found);
  }
}

TEST(Texts, PathsThatAreNamedExist) {
  std::set<std::string> paths;
  const std::vector<fs::path> files = allFiles();
  for (const fs::path& file : files) {
    for (fs::path part = nameOf(file); !part.empty(); part = part.parent_path())
      paths.insert(part.generic_string());
  }
  // Recipes make files, and these tests make up some.
  const std::set<std::string> inventive = {"CONTRIBUTING.md", "CHANGELOG.md",
                                           "tests/lint/source_hash_test.cpp",
                                           "tests/lint/texts_test.cpp"};
  for (const fs::path& file : files) {
    if (!isOneOf(file, {".md", ".h", ".cpp", ".inl", ".glsl", ".cmake", ".txt", ".toml"})) continue;
    if (inventive.contains(nameOf(file))) continue;
    const std::vector<Finding> found = findMissingPaths(nameOf(file), textOf(file), paths);
    EXPECT_TRUE(found.empty()) << format(found);
  }
}

}  // namespace
}  // namespace restlab::lint
