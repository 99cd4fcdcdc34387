// Operations that caches need beyond pixels: words that many pixels write in one pass, and passes
// over entries.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <thread>
#include <vector>

#include "core/backend/backend.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/tally_kernel.h"
#undef RL_KERNEL_BUFFERS  // another kernel's follow
#undef RL_KERNEL_PARAMS
#include "core/bench/stream.h"

namespace rl {
extern const CpuKernelEntry kernel_parity_tally_general;
}

namespace restlab::parity {
namespace {

constexpr uint32_t kWidth = 256, kHeight = 128, kPixels = kWidth * kHeight, kBins = 37;

struct Tally {
  std::vector<uint32_t> counts = std::vector<uint32_t>(kBins, 0);
  std::vector<uint32_t> greatest = std::vector<uint32_t>(kBins, 0);
  std::vector<uint32_t> claims = std::vector<uint32_t>(kBins, rl::RL_INVALID);
  std::vector<uint32_t> claimed = std::vector<uint32_t>(kPixels, 0);
};

// Bins follow rngHash() of the dialect, even enough that every bin has hundreds of pixels.
void expectWhole(const Tally& tally, const Tally* same) {
  EXPECT_EQ(std::accumulate(tally.counts.begin(), tally.counts.end(), 0u), kPixels);
  EXPECT_GT(*std::min_element(tally.counts.begin(), tally.counts.end()), kPixels / kBins / 2);
  // One pixel of each bin came first, and `claims` holds that pixel.
  EXPECT_EQ(std::accumulate(tally.claimed.begin(), tally.claimed.end(), 0u), kBins);
  for (const uint32_t pixel : tally.claims) {
    ASSERT_LT(pixel, kPixels);
    EXPECT_EQ(tally.claimed[pixel], 1u);
  }
  if (same == nullptr) return;
  EXPECT_EQ(tally.counts, same->counts);
  EXPECT_EQ(tally.greatest, same->greatest);
}

Tally tallyOnHost(uint32_t threads) {
  Tally tally;
  const rl::TallyBuffers buffers{{tally.counts.data()},
                                 {tally.greatest.data()},
                                 {tally.claims.data()},
                                 {tally.claimed.data()}};
  const rl::TallyParams params{kBins};
  const rl::SceneData scene{};
  const rl::FrameData frame = plainFrame(kWidth, kHeight, 1);
  rl::CpuKernelArgs args;
  args.scene = &scene;
  args.frame = &frame;
  args.buffers = &buffers;
  args.params = &params;
  std::vector<std::jthread> workers;
  for (uint32_t t = 0; t < threads; ++t) {
    workers.emplace_back([&args, t, threads] {
      rl::CpuKernelCounters counters;
      for (uint32_t y = t; y < kHeight; y += threads)
        rl::kernel_parity_tally_general(args, {0, y, kWidth, y + 1}, counters);
    });
  }
  workers.clear();
  return tally;
}

TEST(AtomicWords, AreThoseOfOneThreadOnManyAndOnADevice) {
  const Tally alone = tallyOnHost(1);
  expectWhole(alone, nullptr);
  expectWhole(tallyOnHost(4), &alone);
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  for (TestDevice& device : testDevices()) {
    Tally tally;
    std::vector<GpuBuffer> buffers;
    std::vector<uint64_t> addresses;
    const auto all = {&tally.counts, &tally.greatest, &tally.claims, &tally.claimed};
    for (std::vector<uint32_t>* words : all) {
      buffers.push_back(device.memory->allocate(words->size() * 4, MemoryKind::device));
      device.memory->write(buffers.back(), words->data(), words->size() * 4);
      addresses.push_back(buffers.back().address);
    }
    const rl::TallyParams params{kBins};
    runOnDevice(device, "tests/parity/tally_kernel.h", "tests/parity/tally_kernel.glsl", 0,
                plainFrame(kWidth, kHeight, 1), addresses, &params, sizeof params);
    size_t i = 0;
    for (std::vector<uint32_t>* words : all) {
      device.memory->read(buffers[i], words->data(), words->size() * 4);
      device.memory->free(buffers[i++]);
    }
    expectWhole(tally, &alone);
  }
}

// A pass over entries covers their rows, whatever the size of the image. (The kernel copies its
// entries.)
void expectEntriesCopied(const std::string& name) {
  const auto scene = sceneNamed("cornell-box");
  const auto backend = makeBackend(name, scene, {});
  constexpr uint32_t kEntries = 8 * rl::RL_ENTRY_ROW, kAll = 2 * kEntries;
  constexpr uint32_t kWords = 4 * rl::RL_STREAM_UVEC4S;  // per entry
  std::vector<uint32_t> from(size_t(kAll) * kWords), to(from.size(), 0);
  std::iota(from.begin(), from.end(), 1u);
  PassRun pass{"stream", backend->maskFor("stream", 0), {}, std::vector<std::byte>(4), kEntries};
  for (int i = 0; i < 2; ++i) pass.buffers.push_back(backend->allocate(from.size() * 4));
  backend->write(pass.buffers[0], from.data(), from.size() * 4);
  rl::FrameData frame = plainFrame(rl::RL_ENTRY_ROW, 3, 1);
  StartupReport report;
  backend->prepare(pass, report);
  backend->submit({pass}, frame);
  backend->collect();
  backend->read(pass.buffers[1], to.data(), to.size() * 4);
  for (size_t i = 0; i < to.size(); ++i)
    ASSERT_EQ(to[i], i < size_t(kEntries) * kWords ? from[i] : 0u) << i;
}

TEST(EntryPasses, RunOverEntriesOnTheCpu) { expectEntriesCopied("cpu"); }

TEST(EntryPasses, RunOverEntriesOnADevice) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  expectEntriesCopied("vulkan");
}

}  // namespace
}  // namespace restlab::parity
