// `restlab view` as a user runs it.
#include <fstream>
#include <optional>

#include "experiments/view/server.h"
#include "tests/cli/program.h"
#include "tests/view/page.h"

namespace restlab::view_test {
namespace {

using cli_test::Circumstances;
using cli_test::ProgramResult;
using Clock = std::chrono::steady_clock;

class ViewProgramTest : public cli_test::ProgramTest {
 protected:
  // What the running program has printed; "" before it has.
  std::string printedUrl() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind(".stdout", 0) != 0) continue;
      const std::string text = read(name);
      if (text.find('\n') != std::string::npos) return text.substr(0, text.find('\n'));
    }
    return "";
  }

  // Ended by the signal once a page is open and `when` holds of it.
  ProgramResult view(int signal, const std::string& arguments,
                     const std::function<bool(Page&)>& when) {
    std::unique_ptr<Page> page;
    Circumstances circumstances;
    circumstances.signal = signal;
    circumstances.maxCpuS = 100.0;
    circumstances.signalWhen = [&] {
      if (printedUrl().empty()) return false;
      if (!page) page = std::make_unique<Page>(printedUrl());
      if (!when(*page)) return false;
      signalled_ = Clock::now();
      return true;
    };
    const ProgramResult result = run("view " + arguments, circumstances);
    ended_ = Clock::now();
    return result;
  }

  double secondsToEnd() const { return std::chrono::duration<double>(ended_ - signalled_).count(); }

  Clock::time_point signalled_, ended_;
};

void expectEnded(const ProgramResult& result) {
  EXPECT_EQ(result.code, 130) << result.err;
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_NE(result.errors()[0].find("interrupted: the viewer ends"), std::string::npos);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_EQ(result.out.rfind("http://127.0.0.1:", 0), 0u) << result.out;
}

TEST_F(ViewProgramTest, EndsInTheMiddleOfAFrame) {
  // The first round would take half an hour.
  std::optional<Clock::time_point> begun;
  const ProgramResult result =
      view(SIGTERM, "furnace --resolution 2048x2048 --max-bounces 1024", [&](Page&) {
        if (!begun) begun = Clock::now();
        return Clock::now() - *begun > std::chrono::milliseconds(1500);
      });
  expectEnded(result);
  EXPECT_LT(secondsToEnd(), 3.0);
}

TEST_F(ViewProgramTest, ShowsTheDefaultsAndKeepsTheReference) {
  const ProgramResult result = view(SIGINT, "", [](Page& page) {
    const Json hello = page.waitFor("hello");
    EXPECT_EQ(hello["scene"]["name"], "door-ajar");
    const Json state = page.waitFor("state");
    EXPECT_EQ(state["panes"][0]["integrator"], "restir_gi");
    EXPECT_EQ(state["panes"][1]["integrator"], "path");
    EXPECT_EQ(state["panes"][1]["denoiser"], "accumulate");
    EXPECT_EQ(state["width"], 320);
    EXPECT_EQ(state["height"], 180);
    page.waitFor("numbers", [](const Json& n) { return n["reference"]["spp"] >= 2; });
    return true;
  });
  expectEnded(result);
  EXPECT_LT(secondsToEnd(), 3.0);
  EXPECT_FALSE(entries("cache/restlab/references").empty());
}

TEST_F(ViewProgramTest, EndsWhileNobodyLooks) {
  Circumstances circumstances;
  circumstances.maxCpuS = 20.0;
  circumstances.signalWhen = [&] { return !printedUrl().empty(); };
  expectEnded(run("view cornell-box", circumstances));
}

TEST_F(ViewProgramTest, SaysWhatIsWrongInOneLine) {
  const ViewServer taken({},
                         {[](ClientId) {}, [](ClientId) {}, [](ClientId, const std::string&) {}});
  const auto port = std::to_string(taken.port());
  write("suite.toml", "scenes = [\"cornell-box\"]\n[[method]]\nintegrator = \"pth\"\n");
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"view cornell-box --resolution 8x8 --port " + port, {"--port " + port, "is taken"}},
      {"view cornell-box --resolution 8x8 --listen everywhere", {"--listen everywhere"}},
      {"view cornell-box --integrator pth", {"'path'"}},
      {"view cornell-box --b-denoiser acumulate", {"'accumulate'"}},
      {"view cornell-box --set confidence_cup=3", {"confidence_cap"}},
      {"view suite.toml", {"suite.toml:3", "'path'"}},
      {"view suite.toml --seed 3", {"--seed", "suite"}},
      {"view cornell-box --port 70000", {"70000"}},
  };
  for (const auto& [arguments, says] : cases) {
    SCOPED_TRACE(arguments);
    cli_test::expectError(run(arguments), 2, says);
  }
  cli_test::expectError(run("view nowhere.gltf"), 3, {"nowhere.gltf"});
}

}  // namespace
}  // namespace restlab::view_test
