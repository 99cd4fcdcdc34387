// Names with control characters, any script or brackets, and unreadable files.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {
namespace {

namespace fs = std::filesystem;

class NamesTest : public ProgramTest {};

// Expects no control characters except line breaks and tabs, neither of ASCII nor of the C1 block.
void expectPlain(const std::string& text) {
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = uint8_t(text[i]), next = uint8_t(i + 1 < text.size() ? text[i + 1] : 0);
    const bool isControl = (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    const bool isSecondBlock = c == 0xc2 && next >= 0x80 && next <= 0x9f;
    ASSERT_FALSE(isControl || isSecondBlock) << "at " << i << " of: " << text;
  }
}

TEST_F(NamesTest, CommandNoTerminal) {
  std::string suite = kSmallSuite;
  suite.replace(suite.find("\"gi\""), 4, "\"g\\u001b[31mi\\u0007\\u009bm\\n| x\"");
  suite.replace(suite.find("name = \"small\""), 14, "name = \"s\\u001b]0;title\\u0007\"");
  write("suite.toml", suite);
  const ProgramResult result = run("run suite.toml -o out --set runs=1");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("| g [31mi  m \\| x |"), std::string::npos) << result.out;
  for (const std::string& text : {result.out, result.err, read("out/table.md")}) expectPlain(text);
  for (const char* arguments :
       {"report out", "status out", "status out --json", "run suite.toml --dry-run"}) {
    SCOPED_TRACE(arguments);
    const ProgramResult other = run(arguments);
    EXPECT_EQ(other.code, 0) << other.err;
    expectPlain(other.out);
    expectPlain(other.err);
  }
  expectPlain(run(std::vector<std::string>{"render", "a\x1b[31m\xc2\x9b.gltf", "-o", "a.exr"}).err);
}

TEST_F(NamesTest, OfAnyScriptStayInFileNames) {
  std::string suite = kSmallSuite;
  suite.replace(suite.find("name = \"small\""), 14, "name = \"K\u00fcche \u65e5\u672c\"");
  suite.replace(suite.find("\"gi\""), 4, "\"\u00dcbung 1\"");
  write("suite.toml", suite);
  const ProgramResult result = run("run suite.toml --set runs=1");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(
      fs::exists(path("results/K\u00fcche-\u65e5\u672c/images/cornell-box-all-\u00dcbung-1.exr")));
}

TEST_F(NamesTest, ScenesOfAnyScriptHaveReports) {
  std::string suite = kSmallSuite;
  suite.replace(suite.find("\"cornell-box\""), 13,
                "\"Zimmer \u00fc.gltf\", \"Zimmer \u00f6.gltf\"");
  write("suite.toml", suite);
  for (const char* name : {"Zimmer \u00fc.gltf", "Zimmer \u00f6.gltf"})
    write(name, triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const ProgramResult result = run("run suite.toml -o out --set runs=1");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto plots = entries("out/plots");
  EXPECT_EQ(plots.size() % 2, 0u);
  EXPECT_GE(plots.size(), 4u) << "of two scenes";
  EXPECT_EQ(run("report out").code, 0);
}

TEST_F(NamesTest, WhyAFileCannotBeReadIsTheSystemsReason) {
  fs::create_symlink("loop.exr", path("loop.exr"));
  fs::create_symlink("loop.toml", path("loop.toml"));
  fs::create_symlink("loop.hdr", path("loop.hdr"));
  fs::create_symlink("loop.gltf", path("loop.gltf"));
  write("file", "");
  writeExr(path("a.exr"), {{{"", Image(4, 4)}}, {}});
  const std::string loop = "Too many levels of symbolic links";
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"run loop.toml", {"loop.toml: cannot be read: " + loop}},
      {"run absent.toml", {"absent.toml: no such file"}},
      {"run file/suite.toml", {"file/suite.toml: cannot be read: Not a directory"}},
      {"compare --ref loop.exr a.exr", {"loop.exr: cannot be read: " + loop}},
      {"compare --ref absent.exr a.exr", {"absent.exr: no such file"}},
      {"render cornell-box -o b.exr --environment loop.hdr", {"loop.hdr: cannot be read: " + loop}},
      {"render loop.gltf -o b.exr", {"loop.gltf: cannot be read: " + loop}},
  };
  for (const auto& [arguments, says] : cases) {
    SCOPED_TRACE(arguments);
    expectError(run(arguments), arguments.rfind("run", 0) == 0 ? 2 : 3, says);
  }
  if (geteuid() == 0) return;  // root may read everything
  fs::permissions(path("a.exr"), fs::perms::none);
  expectError(run("compare --ref a.exr a.exr"), 3, {"a.exr: cannot be read: Permission denied"});
}

TEST_F(NamesTest, OfFoldersAreNoPatterns) {
  fs::create_directories(path("[1] runs*"));
  for (const char* name : {"a-1.exr", "a-2.exr", "b-1.exr"})
    writeExr(path(std::string("[1] runs*/") + name), {{{"", Image(4, 4)}}, {}});
  writeExr(path("ref.exr"), {{{"", Image(4, 4)}}, {}});
  // Two images are too few, but the error shows that they were found.
  for (const std::string& pattern :
       {path("[1] runs*/a-*.exr").string(), std::string("[1] runs*/a-?.exr"),
        std::string("[[]1] runs*/a-[0-9].exr")}) {
    SCOPED_TRACE(pattern);
    expectError(run(std::vector<std::string>{"bias", "--images", pattern, "--ref", "ref.exr"}), 3,
                {"--images: 2 files, the first of which is ", "a-1.exr"});
  }
  expectError(run(std::vector<std::string>{"bias", "--images", "[2]/*.exr", "--ref", "ref.exr"}), 3,
              {"--images [2]/*.exr: no file is called that"});
}

TEST_F(NamesTest, HelpOfAVerbIsItsOwn) {
  const ProgramResult help = run("help view");
  EXPECT_EQ(help.code, 0) << help.err;
  EXPECT_EQ(help.out, run("view --help").out);
  EXPECT_NE(help.out.find("--listen"), std::string::npos);
  EXPECT_EQ(run("help").out, run("--help").out);
  expectError(run("help vieew"), 2, {"'vieew'", "did you mean 'view'?"});
  expectError(run("help view run"), 2, {"one verb"});
}

}  // namespace
}  // namespace restlab::cli_test
