// Reservoirs of restir_gi: what a pass writes, the next one reads.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "core/dialect/order.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/unit/dialect_context.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every payload
namespace rl {

template <uint FEATURES>
struct StoreCtx {
  static constexpr uint kFeatures = FEATURES;

  const SceneData& gScene;
  const FrameData& gFrame;
  const RestirGiBuffers& gBuffers;
  const RestirGiParams& gParams;
  CpuKernelCounters& gCounters;

#include "core/dialect/order.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "integrators/restir_gi/store.glsl"
};

}  // namespace rl

namespace restlab::unit {
namespace {

constexpr uint32_t kSlots = 4, kSlot = 2;

// Every word is another one.
template <class T>
T distinct(uint32_t first) {
  std::array<uint32_t, sizeof(T) / 4> words;
  for (size_t i = 0; i < words.size(); ++i)
    words[i] = std::bit_cast<uint32_t>(1.0f + float(first + i) / 4096.0f);
  T value;
  std::memcpy(&value, words.data(), sizeof value);
  return value;
}

template <class T>
bool isSame(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <uint32_t FEATURES>
struct Store {
  Store() : ctx{scene, frame, buffers, params, counters} {
    const auto give = [this](rl::QuadRef& ref, uint32_t quads) {
      memory.emplace_back(kSlots * quads, glm::uvec4(0xdeadbeefu));
      ref.data = memory.back().data();
    };
    memory.reserve(16);
    give(buffers.reservoirs, rl::RL_PATH_RESERVOIR_QUADS);
    give(buffers.history, rl::RL_PATH_RESERVOIR_QUADS);
    give(buffers.suffixes, rl::RL_PATH_SUFFIX_QUADS);
    give(buffers.suffixesHistory, rl::RL_PATH_SUFFIX_QUADS);
    give(buffers.shifted, 1);
  }
  // Words that differ from what they were at first, outside of the slot.
  size_t touchedElsewhere() const {
    size_t count = 0;
    for (const auto& buffer : memory) {
      const size_t quads = buffer.size() / kSlots;
      for (size_t i = 0; i < buffer.size(); ++i)
        count += i / quads != kSlot && buffer[i] != glm::uvec4(0xdeadbeefu) ? 1 : 0;
    }
    return count;
  }

  std::vector<std::vector<glm::uvec4>> memory;
  rl::SceneData scene{};
  rl::FrameData frame{};
  rl::RestirGiBuffers buffers{};
  rl::RestirGiParams params{};
  rl::CpuKernelCounters counters;
  rl::StoreCtx<FEATURES> ctx;
};

template <uint32_t FEATURES>
void expectReservoirs() {
  Store<FEATURES> store;
  auto& c = store.ctx;
  const bool isGlossy = (FEATURES & rl::RL_FEATURE_GLOSSY) != 0;
  const auto now = distinct<rl::PathReservoir>(0), before = distinct<rl::PathReservoir>(100);
  c.giWriteNow(kSlot, now);
  c.giWriteHistory(kSlot, before);
  const auto expect = [&](const rl::PathReservoir& read, const rl::PathReservoir& written) {
    rl::PathReservoir kept = written;
    if (!isGlossy) kept.path.suffix = rl::PathSuffix{};
    EXPECT_TRUE(isSame(read, kept));
  };
  rl::PathReservoir read{};
  c.giReadNow(kSlot, read);
  expect(read, now);
  c.giReadBefore(kSlot, read);
  expect(read, before);
  // The state alone leaves the path as it is.
  rl::PathReservoir changed = now;
  changed.state = distinct<rl::ReservoirState>(300);
  c.giWriteStateNow(kSlot, changed.state);
  c.giReadNow(kSlot, read);
  expect(read, changed);
  rl::ReservoirState state{};
  c.giReadStateNow(kSlot, state);
  EXPECT_TRUE(isSame(state, changed.state));
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

TEST(ReservoirStore, ReservoirsAreReadAsTheyWereWritten) {
  expectReservoirs<rl::RL_FEATURE_ALL>();
  expectReservoirs<0>();
}

TEST(ReservoirStore, ShiftedSamplesAreReadAsTheyWereWritten) {
  Store<rl::RL_FEATURE_ALL> store;
  store.params.spatialNeighbours = 1;
  const auto written = distinct<rl::Shifted>(0);
  const uint32_t index = store.ctx.giExchangeIndex(kSlot, 0);
  store.ctx.giWriteShifted(index, written);
  EXPECT_TRUE(isSame(store.ctx.giReadShifted(index), written));
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

// A light in a reservoir is the light again.
TEST(ReservoirStore, LightsComeBack) {
  Store<rl::RL_FEATURE_ALL> store;
  auto light = distinct<rl::LightSample>(0);
  light.kind = rl::RL_LIGHT_SPOT;
  light.isTwoSided = 0;
  const rl::LightSample back = store.ctx.pathLight(store.ctx.pathOfLight(light, 7));
  light.pdf = 0.0f;  // is not kept
  EXPECT_TRUE(isSame(back, light));
}

}  // namespace
}  // namespace restlab::unit
