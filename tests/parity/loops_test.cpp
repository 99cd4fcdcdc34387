// Drivers that end loops are found out.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/loops_kernel.h"

namespace restlab::parity {
namespace {

struct LoopsRun {
  size_t wrong = 0;  // pixels that turned less often than they were told to
  uint32_t counted = 0;
};

LoopsRun runLoops(TestDevice& device, const rl::LoopsParams& params) {
  constexpr uint32_t kWidth = 32, kHeight = 16;
  std::vector<uint32_t> turned(kWidth * kHeight, 0);
  const size_t bytes = turned.size() * sizeof turned[0];
  const GpuBuffer buffer = device.memory->allocate(bytes, MemoryKind::device);
  const GpuBuffer states = device.memory->allocate(bytes, MemoryKind::device);
  const GlslCounters counters = runOnDevice(
      device, "tests/parity/loops_kernel.h", "tests/parity/loops_kernel.glsl", 0,
      plainFrame(kWidth, kHeight, 1), {buffer.address, states.address}, &params, sizeof params);
  device.memory->read(buffer, turned.data(), bytes);
  device.memory->free(buffer);
  device.memory->free(states);
  const uint32_t all = params.outer * params.inner;
  const auto right = std::count(turned.begin(), turned.end(), all);
  return {turned.size() - size_t(right), counters.health[rl::RL_HEALTH_LOOPS_CUT]};
}

TEST(Loops, ThatADriverEndedAreCounted) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (TestDevice& device : testDevices()) {
    const LoopsRun brief = runLoops(device, {50, 100});
    EXPECT_EQ(brief.wrong, 0u) << device.name();
    EXPECT_EQ(brief.counted, 0u) << device.name();
    const LoopsRun endless = runLoops(device, {1000, 100});
    EXPECT_EQ(endless.counted, endless.wrong) << device.name();
    // A lavapipe that ends no loops needs no count: these lines would go.
    const bool isLavapipe = device.name().find("llvmpipe") != std::string::npos;
    EXPECT_TRUE(!isLavapipe || endless.wrong > 0);
  }
}

}  // namespace
}  // namespace restlab::parity
