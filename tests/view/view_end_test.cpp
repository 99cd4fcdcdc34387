// Signals that end the viewer, besides SIGINT and SIGTERM.
#include <chrono>
#include <csignal>

#include "tests/cli/program.h"

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

  // Returns the process whose working folder is the test's; 0: none.
  pid_t viewer() const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
      const fs::path folder = fs::read_symlink(entry.path() / "cwd", error);
      if (!error && folder == fs::canonical(folder_))
        return pid_t(std::stoi(entry.path().filename().string()));
    }
    return 0;
  }
};

TEST_F(ViewEndTest, AHangUpEndsItAsSigtermDoes) {
  cli_test::Circumstances circumstances;
  circumstances.signal = SIGHUP;
  circumstances.signalWhen = [&] { return !printedUrl().empty(); };
  const cli_test::ProgramResult result = run("view cornell-box --resolution 8x8", circumstances);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_NE(result.err.find("interrupted: the viewer ends"), std::string::npos) << result.err;
}

// `nohup` ignores SIGHUP, and the viewer must keep that.
TEST_F(ViewEndTest, AnIgnoredHangUpIsNoEnd) {
  cli_test::Circumstances circumstances;
  circumstances.signal = SIGTERM;
  pid_t hearing = 0;
  Clock::time_point hungUp;
  circumstances.signalWhen = [&] {
    if (printedUrl().empty()) return false;
    if (hearing == 0) {
      hearing = viewer();
      kill(hearing, SIGHUP);
      hungUp = Clock::now();
    }
    return Clock::now() - hungUp > std::chrono::milliseconds(200);
  };
  const auto before = std::signal(SIGHUP, SIG_IGN);
  const cli_test::ProgramResult result = run("view cornell-box --resolution 8x8", circumstances);
  std::signal(SIGHUP, before);
  EXPECT_NE(hearing, 0);
  EXPECT_GT(Clock::now() - hungUp, std::chrono::milliseconds(200)) << "it ended before";
  EXPECT_EQ(result.code, 130) << result.err;
}

}  // namespace
}  // namespace restlab::view_test
