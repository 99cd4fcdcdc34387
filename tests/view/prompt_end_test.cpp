// A process whose thread cannot react to signals still ends, and leaves complete files.
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>

#include "core/backend/stop.h"
#include "core/image/io/atomic_file.h"
#include "experiments/view/prompt_end.h"
#include "tests/runner/temporary_folder.h"

namespace restlab::view_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;
using std::chrono::milliseconds;
using ::testing::ExitedWithCode;

class PromptEndDeathTest : public TemporaryFolder {
 protected:
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder())) all.insert(entry.path().filename());
    return all;
  }
};

// Behaves like a driver that compiles a kernel.
[[noreturn]] void hangForAMinute() {
  alarm(60);  // ends the test if nothing else does
  while (true) pause();
}

TEST_F(PromptEndDeathTest, EndsWhatHearsNoSignal) {
  writeTextFile(folder() / "session.toml", "before");
  EXPECT_EXIT(
      {
        const PromptEnd end("interrupted: the viewer ends", milliseconds(1));
        writeTextFile(folder() / "kept.toml", "whole");
        AtomicFile half(folder() / "session.toml");
        half.stream() << "half of it" << std::flush;
        AtomicFile dropped(folder() / "new.toml");
        stopFrames();
        hangForAMinute();
      },
      ExitedWithCode(130), "^interrupted: the viewer ends\n$");
  EXPECT_EQ(names(), (std::set<std::string>{"session.toml", "kept.toml"}));
  EXPECT_EQ(fs::file_size(folder() / "session.toml"), 6u);
  EXPECT_EQ(fs::file_size(folder() / "kept.toml"), 5u);
}

TEST_F(PromptEndDeathTest, SaysNothingTwice) {
  EXPECT_EXIT(
      {
        PromptEnd end("interrupted", milliseconds(1));
        end.setSaid();
        stopFrames();
        hangForAMinute();
      },
      ExitedWithCode(130), "^$");
}

TEST_F(PromptEndDeathTest, LeavesAnOrderlyEndAlone) {
  EXPECT_EXIT(
      {
        {
          const PromptEnd end("interrupted", hours(1));
          stopFrames();
        }
        std::_Exit(7);
      },
      ExitedWithCode(7), "^$");
}

TEST_F(PromptEndDeathTest, WaitsForASignal) {
  EXPECT_EXIT(
      {
        const PromptEnd end("interrupted", milliseconds(0));
        std::this_thread::sleep_for(milliseconds(100));
        std::_Exit(7);
      },
      ExitedWithCode(7), "^$");
}

}  // namespace
}  // namespace restlab::view_test
