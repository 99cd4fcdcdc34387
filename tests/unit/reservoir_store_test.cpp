// Anchors and reservoirs of restir_gi: what a pass writes, the next one reads.
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
    give(buffers.anchors, rl::RL_GI_ANCHOR_QUADS);
    give(buffers.previousAnchors, rl::RL_GI_ANCHOR_QUADS);
    give(buffers.anchorsGlossy, 1);
    give(buffers.previousAnchorsGlossy, 1);
    give(buffers.lights, rl::RL_GI_LIGHT_QUADS);
    give(buffers.lightsHistory, rl::RL_GI_LIGHT_QUADS);
    give(buffers.paths, rl::RL_GI_PATH_QUADS);
    give(buffers.pathsHistory, rl::RL_GI_PATH_QUADS);
    give(buffers.suffixes, rl::RL_GI_SUFFIX_QUADS);
    give(buffers.suffixesHistory, rl::RL_GI_SUFFIX_QUADS);
    give(buffers.shiftedLights, 1);
    give(buffers.shiftedPaths, 1);
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
  const auto light = distinct<rl::LightReservoir>(0), older = distinct<rl::LightReservoir>(50);
  const auto path = distinct<rl::PathReservoir>(100), olderPath = distinct<rl::PathReservoir>(200);
  c.cacheWriteNow(kSlot, light);
  c.cacheWriteHistory(kSlot, older);
  c.cacheWriteNow(kSlot, path);
  c.cacheWriteHistory(kSlot, olderPath);
  rl::LightReservoir readLight;
  c.cacheReadNow(kSlot, readLight);
  EXPECT_TRUE(isSame(readLight, light));
  c.cacheReadBefore(kSlot, readLight);
  EXPECT_TRUE(isSame(readLight, older));
  rl::PathReservoir readPath{};
  const auto expectPath = [&](const rl::PathReservoir& written) {
    EXPECT_TRUE(isSame(readPath.vertex, written.vertex));
    EXPECT_TRUE(isSame(readPath.state, written.state));
    EXPECT_TRUE(isSame(readPath.suffix, isGlossy ? written.suffix : rl::PathSuffix{}));
  };
  c.cacheReadNow(kSlot, readPath);
  expectPath(path);
  c.cacheReadBefore(kSlot, readPath);
  expectPath(olderPath);
  // The state alone leaves the payload as it is.
  rl::LightReservoir changed = light;
  changed.state = distinct<rl::ReservoirState>(300);
  c.cacheWriteStateNow(kSlot, changed);
  c.cacheReadNow(kSlot, readLight);
  EXPECT_TRUE(isSame(readLight, changed));
  rl::LightReservoir state = light;
  c.cacheReadStateNow(kSlot, state);
  EXPECT_TRUE(isSame(state, changed));
  c.cacheWriteStateHistory(kSlot, changed);
  c.cacheReadBefore(kSlot, readLight);
  EXPECT_TRUE(isSame(readLight.state, changed.state));
  EXPECT_TRUE(isSame(readLight.light, older.light));
  rl::PathReservoir changedPath = path;
  changedPath.state = distinct<rl::ReservoirState>(400);
  c.cacheWriteStateNow(kSlot, changedPath);
  c.cacheReadNow(kSlot, readPath);
  expectPath(changedPath);
  readPath.state = path.state;
  c.cacheReadStateNow(kSlot, readPath);
  expectPath(changedPath);
  c.cacheWriteStateHistory(kSlot, changedPath);
  c.cacheReadBefore(kSlot, readPath);
  EXPECT_TRUE(isSame(readPath.state, changedPath.state));
  EXPECT_TRUE(isSame(readPath.vertex, olderPath.vertex));
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

TEST(ReservoirStore, ReservoirsAreReadAsTheyWereWritten) {
  expectReservoirs<rl::RL_FEATURE_ALL>();
  expectReservoirs<0>();
}

TEST(ReservoirStore, ShiftedSamplesOfBothKindsLieApart) {
  Store<rl::RL_FEATURE_ALL> store;
  store.params.spatialNeighbours = 1;
  const auto a = distinct<rl::Shifted>(0), b = distinct<rl::Shifted>(10);
  const rl::LightReservoir light{};
  const rl::PathReservoir path{};
  const uint32_t index = store.ctx.cacheExchangeIndex(kSlot, 0);
  store.ctx.cacheWriteShifted(index, light, a);
  store.ctx.cacheWriteShifted(index, path, b);
  rl::Shifted read;
  store.ctx.cacheReadShifted(index, light, read);
  EXPECT_TRUE(isSame(read, a));
  store.ctx.cacheReadShifted(index, path, read);
  EXPECT_TRUE(isSame(read, b));
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

template <uint32_t FEATURES>
void expectAnchors() {
  Store<FEATURES> store;
  store.frame.camera.kind = rl::RL_CAMERA_PERSPECTIVE;
  store.frame.camera.posW = {1.0f, 2.0f, 3.0f};
  store.frame.previousCamera = store.frame.camera;
  store.frame.previousCamera.posW = {4.0f, 5.0f, 6.0f};
  const auto written = distinct<rl::Anchor>(0);
  store.ctx.cacheWriteAnchor(kSlot, written);
  const auto expectRead = [&](const rl::Anchor& read, const rl::Camera& camera) {
    EXPECT_EQ(read.posW, written.posW);
    EXPECT_EQ(read.posError, written.posError);
    EXPECT_EQ(read.nGeoW, written.nGeoW);
    EXPECT_EQ(read.nShadeW, written.nShadeW);
    EXPECT_EQ(read.isReusable, written.isReusable);
    EXPECT_EQ(read.bsdf.diffuse, written.bsdf.diffuse);
    EXPECT_LT(glm::length(read.wo - glm::normalize(camera.posW - written.posW)), 1e-6f);
    EXPECT_EQ(read.bsdf.eta, 1.0f);
    EXPECT_EQ(read.bsdf.transmission, glm::vec3(0.0f));
    const bool isGlossy = (FEATURES & rl::RL_FEATURE_GLOSSY) != 0;
    EXPECT_EQ(read.bsdf.f0, isGlossy ? written.bsdf.f0 : glm::vec3(0.0f));
    EXPECT_EQ(read.bsdf.f90, isGlossy ? written.bsdf.f90 : 0.0f);
    EXPECT_EQ(read.bsdf.alpha, isGlossy ? written.bsdf.alpha : 1.0f);
    EXPECT_EQ(read.bsdf.lobes, isGlossy ? written.bsdf.lobes : rl::RL_LOBE_DIFFUSE);
  };
  expectRead(store.ctx.cacheAnchorNow(kSlot), store.frame.camera);
  // As sessions do between frames.
  std::swap(store.buffers.anchors, store.buffers.previousAnchors);
  std::swap(store.buffers.anchorsGlossy, store.buffers.previousAnchorsGlossy);
  expectRead(store.ctx.cacheAnchorBefore(kSlot), store.frame.previousCamera);
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

TEST(ReservoirStore, AnchorsAreReadAsTheyWereWritten) {
  expectAnchors<rl::RL_FEATURE_ALL>();
  expectAnchors<0>();
}

}  // namespace
}  // namespace restlab::unit
