// Runs the program on every broken glTF file of the collection: exit code 0 or 3, one line, no file
// left behind, bounded time and memory. In a sanitizer build, errors that it finds give another
// exit code.
#include <fmt/format.h>

#include "tests/cli/program.h"

#include <algorithm>
#include "tests/scene/corpus.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

// The slowest file takes 0.1 s and 60 MiB; with a sanitizer 1 s and 110 MiB.
constexpr double kMostSeconds = 20.0;
constexpr uint64_t kMostBytes = uint64_t(400) << 20;

class BrokenScenes : public ProgramTest {
 protected:
  // Runs `verb`, the scene and `options` for each broken file.
  void runAll(const std::string& verb, const std::vector<std::string>& options) {
    const fs::path folder = fs::absolute(test::sceneFolder() / "bad-gltf");
    SKIP_WITHOUT(folder);
    Circumstances bounded;
    bounded.maxCpuS = kMostSeconds;
    size_t accepted = 0, refused = 0;
    for (const fs::path& file : test::gltfsBelow(folder)) {
      std::vector<std::string> words = {verb, file.string()};
      words.insert(words.end(), options.begin(), options.end());
      const ProgramResult result = run(words, bounded);
      const bool isRead = result.code == 0;
      EXPECT_TRUE(isRead || result.code == 3) << file << ": " << result.code << '\n' << result.err;
      EXPECT_LT(result.peakBytes, kMostBytes) << file;
      EXPECT_EQ(result.errors().size(), isRead ? 0u : 1u) << file << '\n' << result.err;
      if (!isRead) {
        EXPECT_EQ(result.err.find("error: " + file.string() + ": "), 0u) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.out, "") << file;
      }
      EXPECT_EQ(fs::exists(path("x.exr")), isRead && verb == "render") << file;
      fs::remove(path("x.exr"));
      ++(isRead ? accepted : refused);
    }
    std::cout << accepted << " accepted, " << refused << " refused\n";
    EXPECT_GT(accepted, 0u);
    EXPECT_GT(refused, 0u);
  }
};

TEST_F(BrokenScenes, InfoIsOneLineAndAnExitCode) { runAll("info", {}); }

TEST_F(BrokenScenes, RenderIsOneLineAndAnExitCode) {
  runAll("render", {"-o", "x.exr", "--resolution", "4x4", "-t", "1"});
}

TEST_F(BrokenScenes, NamesCannotSteerATerminal) {
  std::string scene = triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0});
  scene.insert(scene.find("\"type\": \"perspective\""), R"("name": "red\u001b[31m\nline", )");
  write("names.gltf", scene);
  const ProgramResult good = run("info names.gltf");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_NE(good.out.find("'red [31m line'"), std::string::npos) << good.out;
  expectError(run("render names.gltf -o x.exr --camera \x1b[31m"), 2, {"red [31m line"});
}

}  // namespace

}  // namespace restlab::cli_test
