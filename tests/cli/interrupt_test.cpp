// A signal stops a frame in the middle: a frame may take hours.
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

class InterruptTest : public ProgramTest {
 protected:
  // Sends the signal inside the first frame, which would take half an hour.
  ProgramResult endInAFrame(int signal, const std::string& arguments) const {
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> begun;
    Circumstances circumstances;
    circumstances.signal = signal;
    circumstances.maxCpuS = 100.0;  // ends a program that ignores signals
    circumstances.signalWhen = [&] {
      if (!begun) begun = Clock::now();  // the program handles signals from here on
      return Clock::now() - *begun > std::chrono::milliseconds(1500);
    };
    return run(arguments + " furnace --resolution 2048x2048 --max-bounces 1024", circumstances);
  }
};

TEST_F(InterruptTest, EndsAFrameOfTheCpu) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ProgramResult result = endInAFrame(signal, "render -o image.exr --spp 4");
    expectError(result, 130, {"interrupted: the image is not finished and was not written"});
    EXPECT_FALSE(fs::exists(path("image.exr")));
  }
}

TEST_F(InterruptTest, EndsAFrameOfTheDevice) {
  const auto backends = nlohmann::json::parse(run("list backends --json").out);
  for (const auto& backend : backends) {
    if (backend["name"] == "vulkan" && !backend["available"].get<bool>())
      GTEST_SKIP() << "SKIPPED: " << backend["why_not"].get<std::string>();
  }
  const ProgramResult result = endInAFrame(SIGTERM, "render -o image.exr --spp 4 --backend vulkan");
  expectError(result, 130, {"interrupted: the image is not finished and was not written"});
  EXPECT_FALSE(fs::exists(path("image.exr")));
}

TEST_F(InterruptTest, EndsASampleOfAReference) {
  const ProgramResult result = endInAFrame(SIGTERM, "reference -o ref.exr --spp 64");
  expectError(result, 130, {"interrupted: the reference is not finished"});
  EXPECT_FALSE(fs::exists(path("ref.exr")));
}

}  // namespace
}  // namespace restlab::cli_test
