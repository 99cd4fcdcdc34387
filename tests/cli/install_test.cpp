// The installed program, library and CMake package, used from a tree that was moved.
#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/lint/command.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;
using lint::CommandResult;
using lint::runCommand;

// Installs what every build has, without the Python module.
class Installed : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (std::string(RESTLAB_LIBRARY).empty()) GTEST_SKIP() << "this build has no librestlab.so";
    const CommandResult result = runCommand(RESTLAB_CMAKE " --install '" RESTLAB_BUILD_DIR
                                                          "' --component Unspecified --prefix '" +
                                            path("first").string() + "'");
    ASSERT_EQ(result.status, 0) << result.output;
    fs::create_directories(path("moved"));
    fs::rename(path("first"), tree());
  }

  fs::path tree() const { return path("moved") / "here"; }

  // Runs a shell command in this test's folder, with the moved program before all others.
  CommandResult shell(const std::string& command) const {
    return runCommand("cd '" + folder_.string() + "' && PATH='" + (tree() / "bin").string() +
                      "':$PATH && " + command);
  }
};

TEST_F(Installed, MovedTreeHasProgramPagesLibraryAndPackage) {
  // Suites and scenes by name.
  CommandResult result = shell("restlab run quickstart --dry-run");
  EXPECT_EQ(result.status, 0) << result.output;
  result = shell("restlab run certificates-materials.toml --dry-run --scenes 'table'");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(shell("restlab info mitsuba.xml").status, 0);
  EXPECT_NE(shell("restlab list scenes").output.find("materials.scene.toml"), std::string::npos);
  result = shell("restlab run quickstrat --dry-run");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.output.find("did you mean 'quickstart'?"), std::string::npos) << result.output;
  EXPECT_EQ(shell("restlab run cornell-box --dry-run").status, 2) << "a scene, and no suite";

  // Pages of the manual and completion know the verbs and their options.
  EXPECT_TRUE(fs::exists(tree() / "share/man/man1/restlab-distance-field.1"));
  EXPECT_NE(read("moved/here/share/man/man1/restlab-render.1").find("\n\\fB\\-\\-integrator\\fR"),
            std::string::npos);
  write("complete.sh", R"(source moved/here/share/bash-completion/completions/restlab
complete() { COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _restlab; echo "${COMPREPLY[*]}"; }
complete restlab run quickst
complete restlab render corn
complete restlab render x --integrator = restir_d
complete restlab bias x --se
complete restlab reference x --integrator ''
complete restlab render x --backend = v
complete restlab render x --set mis =
complete restlab render x --set temporal = t
complete restlab render x --set confidence_cap = corn
complete restlab run x --set mis =
)");
  EXPECT_EQ(shell("bash complete.sh").output,
            "quickstart\ncornell-box\nrestir_di\n--seed --set\npath bdpt\nvulkan\n"
            "confidence defensive pairwise\ntrue\n\n\n");

  // Names that the library shows are restlab's own.
  result = shell("nm -D --defined-only $(find moved/here -name librestlab.so) | awk '{print $3}'");
  std::istringstream symbols(result.output);
  size_t count = 0;
  for (std::string symbol; std::getline(symbols, symbol); ++count)
    EXPECT_NE(symbol.find("7restlab"), std::string::npos) << symbol;
  EXPECT_GT(count, 1000u);

  // The example is built, and renders what the program does.
  result = shell(std::string(RESTLAB_CMAKE) +
                 " -S '" RESTLAB_SOURCE_DIR
                 "/experiments/example' -B example "
                 "-G Ninja -D CMAKE_PREFIX_PATH=\"$PWD/moved/here\" && " RESTLAB_CMAKE
                 " --build example");
  ASSERT_EQ(result.status, 0) << result.output;
  result = shell("example/example cornell-box 3 example.exr");
  ASSERT_EQ(result.status, 0) << result.output;
  result = shell(
      "restlab render cornell-box --integrator restir_gi --set spatial_neighbours=2 "
      "--resolution 64x64 --frames 3 --aov albedo -o program.exr");
  ASSERT_EQ(result.status, 0) << result.output;
  const LayeredImage own = readExr(path("example.exr")), program = readExr(path("program.exr"));
  ASSERT_EQ(own.layers.size(), 2u);
  ASSERT_EQ(program.layers.size(), 2u);
  for (const auto& [name, image] : own.layers)
    EXPECT_TRUE(image.pixels == program.layers.at(name).pixels) << "layer '" << name << "'";
  // An exception of the library is caught as what it is.
  result = shell("example/example cornel-box 3 example.exr");
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.output.find("did you mean 'cornell-box'?"), std::string::npos) << result.output;
}

TEST_F(Installed, DocumentsHaveWhatTheyLinkTo) {
  const std::regex link("\\]\\(([^)#: ]+)[^): ]*\\)");
  size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(tree() / "share/doc")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = read(entry.path().lexically_relative(folder_).string());
    for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found) {
      const fs::path target = entry.path().parent_path() / (*found)[1].str();
      EXPECT_TRUE(fs::exists(target)) << entry.path().filename() << ": " << (*found)[0];
      ++count;
    }
  }
  EXPECT_GT(count, 300u);
}

TEST_F(Installed, NightlyEveryHeaderCompilesAlone) {
  const fs::path includes = tree() / "include/restlab";
  size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(includes)) {
    if (!entry.is_regular_file()) continue;
    ++count;
    const std::string name = entry.path().lexically_relative(includes).string();
    write("alone.cpp", "#include \"" + name + "\"\n#include \"" + name + "\"\n");
    const CommandResult result =
        shell(RESTLAB_GXX " -std=c++20 -fsyntax-only -I moved/here/include/restlab alone.cpp");
    EXPECT_EQ(result.status, 0) << name << ":\n" << result.output;
  }
  EXPECT_GT(count, 10u);
}

}  // namespace

}  // namespace restlab::cli_test
