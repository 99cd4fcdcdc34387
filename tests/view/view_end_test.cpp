// What ends with the viewer, however it ends.
#include <csignal>
#include <thread>
#include <vector>

#include "tests/cli/program.h"
#include "tests/view/page.h"

namespace restlab::view_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class ViewEndTest : public cli_test::ProgramTest {
 protected:
  std::string printedUrl() const {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind(".stdout", 0) != 0) continue;
      const std::string text = read(name);
      if (text.find('\n') != std::string::npos) return text.substr(0, text.find('\n'));
    }
    return "";
  }

  // Those that work in the test's folder: the viewer, and a run that it has begun.
  std::vector<pid_t> processes() const {
    std::vector<pid_t> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
      const fs::path folder = fs::read_symlink(entry.path() / "cwd", error);
      if (!error && folder == fs::canonical(folder_))
        found.push_back(pid_t(std::stoi(entry.path().filename().string())));
    }
    return found;
  }
  pid_t childOfOurs() const {
    const std::vector<pid_t> all = processes();
    return all.empty() ? 0 : all.front();
  }
};

TEST_F(ViewEndTest, TheRunEndsWithAViewerThatIsKilledOrLosesItsTerminal) {
  for (const auto& [signal, code] : {std::pair(SIGKILL, 128 + SIGKILL), {SIGHUP, 130}}) {
    SCOPED_TRACE(signal);
    cli_test::Circumstances circumstances;
    circumstances.signal = signal;
    std::unique_ptr<Page> page;
    bool isAsked = false;
    circumstances.signalWhen = [&] {
      if (printedUrl().empty()) return false;
      if (!page) page = std::make_unique<Page>(printedUrl());
      if (!isAsked) page->say({{"do", "measure"}, {"name", "long"}});
      isAsked = true;
      return processes().size() >= 2;
    };
    // The reference of its suite would take hours.
    write("suite.toml",
          "name = \"s\"\nscenes = [\"cornell-box\"]\n[settings]\nwidth = 256\nheight = 256\n"
          "max_bounces = 64\n[reference]\nspp = 1000\n[[method]]\nintegrator = \"path\"\n"
          "[[method]]\nintegrator = \"restir_gi\"\n");
    EXPECT_EQ(run("view suite.toml", circumstances).code, code);
    const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
    while (!processes().empty() && Clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(processes().empty()) << "its run goes on";
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry);
  }
}

// As `nohup` has it: what is ignored stays so.
TEST_F(ViewEndTest, AnIgnoredHangUpIsNoEnd) {
  cli_test::Circumstances circumstances;
  circumstances.signal = SIGTERM;
  pid_t viewer = 0;
  Clock::time_point hungUp;
  circumstances.signalWhen = [&] {
    if (printedUrl().empty()) return false;
    if (viewer == 0) {
      viewer = childOfOurs();
      kill(viewer, SIGHUP);
      hungUp = Clock::now();
    }
    return Clock::now() - hungUp > std::chrono::milliseconds(200);
  };
  const auto before = std::signal(SIGHUP, SIG_IGN);
  const cli_test::ProgramResult result = run("view cornell-box --resolution 8x8", circumstances);
  std::signal(SIGHUP, before);
  EXPECT_NE(viewer, 0);
  EXPECT_GT(Clock::now() - hungUp, std::chrono::milliseconds(200)) << "it ended before";
  EXPECT_EQ(result.code, 130) << result.err;
}

}  // namespace
}  // namespace restlab::view_test
