// Reservoirs of restir_gi: a pass reads what the pass before has written.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "core/dialect/order.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/unit/dialect_context.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
namespace rl {

struct StoreCtx {
  static constexpr FeatureMask kFeatures = RL_FEATURE_ALL;

  const SceneData& gScene;
  const FrameData& gFrame;
  const ReuseBuffers& gBuffers;
  const PathReuseParams& gParams;
  CpuKernelCounters& gCounters;

#include "core/dialect/order.glsl"
  // Tests trace no rays.
  float traceRay(const Ray&, uint, uint, Hit&) { return 0.0f; }
#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/reservoir_store.glsl"
};

}  // namespace rl

namespace restlab::unit {
namespace {

constexpr uint32_t kSlots = 4, kSlot = 2;

template <class T>
bool isSame(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

struct Store {
  Store() : ctx{scene, frame, buffers, params, counters} {
    const auto give = [this](rl::Uvec4Ref& ref, uint32_t uvec4s) {
      memory.emplace_back(kSlots * uvec4s, glm::uvec4(0xdeadbeefu));
      ref.data = memory.back().data();
    };
    memory.reserve(16);
    give(buffers.reservoirs, rl::RL_PATH_RESERVOIR_UVEC4S);
    give(buffers.history, rl::RL_PATH_RESERVOIR_UVEC4S);
    give(buffers.pairedShifts0, 1);
  }
  // Counts words outside the slot that differ from their initial value.
  size_t touchedElsewhere() const {
    size_t count = 0;
    for (const auto& buffer : memory) {
      const size_t uvec4s = buffer.size() / kSlots;
      for (size_t i = 0; i < buffer.size(); ++i)
        count += i / uvec4s != kSlot && buffer[i] != glm::uvec4(0xdeadbeefu) ? 1 : 0;
    }
    return count;
  }

  std::vector<std::vector<glm::uvec4>> memory;
  rl::SceneData scene{};
  rl::FrameData frame{};
  rl::ReuseBuffers buffers{};
  rl::PathReuseParams params{};
  rl::CpuKernelCounters counters;
  rl::StoreCtx ctx;
};

// Makes a reservoir whose numbers lose nothing by packing: at most 12 bits of fraction, unit
// vectors.
rl::PathReservoir reservoir(float first) {
  const auto vector = [&first](float sign = 1.0f) {
    first += 1.0f;
    return glm::vec3(first, first + 0.25f, sign * (first + 0.5f));
  };
  rl::PathReservoir r{};
  r.path.id = {7u + uint32_t(first), 0xfffffff0u, {0.25f + first / 1024.0f, 0.5f}};
  r.path.kind = rl::RL_PATH_CONTINUATION | rl::RL_PATH_BACK;
  r.path.film = 0x12345678u + uint32_t(first);
  r.path.radiance = vector();
  r.path.geometry = 0.1f * first;
  r.path.wi = glm::normalize(vector(-1.0f));
  r.path.pdfLight = 0.75f * std::exp2(std::floor(std::log2(first)));
  r.state.F = vector();
  r.state.W = 0.3f * first;
  r.state.residual = vector(-1.0f);
  r.state.confidence = 1.7f + first;
  return r;
}

constexpr float kUnit = 1.5e-6f;  // error of packUnit22()

void expectState(const rl::ReservoirState& read, const rl::ReservoirState& written) {
  EXPECT_TRUE(isSame(read, written));
}
void expectPath(const rl::PathSample& read, const rl::PathSample& written) {
  EXPECT_TRUE(isSame(read.id, written.id));
  EXPECT_EQ(read.kind, written.kind);
  EXPECT_EQ(read.film, written.film);
  EXPECT_EQ(read.radiance, written.radiance);
  EXPECT_EQ(read.geometry, written.geometry);
  EXPECT_LT(glm::distance(read.wi, written.wi), kUnit);
  EXPECT_EQ(read.pdfLight, written.pdfLight);
}

TEST(ReservoirStore, ReservoirsAreReadAsTheyWereWritten) {
  Store store;
  auto& c = store.ctx;
  const rl::PathReservoir now = reservoir(1.0f), before = reservoir(100.0f);
  c.reservoirWriteNow(kSlot, now);
  c.reservoirWriteHistory(kSlot, before);
  rl::PathReservoir read = c.reservoirReadNow(kSlot);
  expectState(read.state, now.state);
  expectPath(read.path, now.path);
  read = c.reservoirReadPrevious(kSlot);
  expectState(read.state, before.state);
  expectPath(read.path, before.path);
  // Writing only the state must leave the path unchanged.
  rl::PathReservoir changed = now;
  changed.state = reservoir(300.0f).state;
  c.stateWriteNow(kSlot, changed);
  expectState(c.stateReadNow(kSlot), changed.state);
  expectState(c.stateReadPrevious(kSlot), before.state);
  read = c.reservoirReadNow(kSlot);
  expectPath(read.path, now.path);
  // Taking only the path must leave the state unchanged.
  c.takeSamplePrevious(kSlot, read);
  expectState(read.state, changed.state);
  expectPath(read.path, before.path);
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

// A path is evaluated with the direction and the density that words hold, from the start.
TEST(ReservoirStore, WhatWordsHoldIsAFixedPoint) {
  Store store;
  auto& c = store.ctx;
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 10'000; ++i) {
    rl::PathReservoir r = reservoir(1.0f);
    r.path.wi =
        c.pathPackedWi(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
    r.path.pdfLight = c.pathPackedPdf(std::exp(8.0f * normal(random)));
    c.reservoirWriteNow(kSlot, r);
    const rl::PathSample read = c.reservoirReadNow(kSlot).path;
    ASSERT_EQ(read.wi, r.path.wi);
    ASSERT_EQ(read.pdfLight, r.path.pdfLight);
  }
}

TEST(ReservoirStore, ShiftedSamplesAreReadAsTheyWereWritten) {
  Store store;
  store.params.reuse.spatialNeighbours = 1;
  const rl::Shifted written{{0.5f, 3.0f, 0.25f}, 0.3f};
  store.ctx.shiftedWrite(store.ctx.pairedShifts(0), kSlot, written, 77);
  uint32_t partner = 0;
  EXPECT_TRUE(isSame(store.ctx.shiftedRead(store.ctx.pairedShifts(0), kSlot, partner), written));
  EXPECT_EQ(partner, 77u);
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

// A spot light in a reservoir comes back unchanged: of it the reservoir has the index alone.
TEST(ReservoirStore, PointLightsComeBack) {
  Store store;
  std::vector<rl::Light> table(3);
  table[2].p0 = {1.0f, 2.0f, 3.0f};
  table[2].e2 = {0.5f, 0.25f, 1.0f};
  store.scene.lights.data = table.data();
  rl::LightSample light{};
  light.kind = rl::RL_LIGHT_POINT;
  light.point = table[2].p0;
  light.normal = table[2].e2;  // its attenuation
  light.radiance = {4.0f, 5.0f, 6.0f};
  light.record = light.id.instance = 2;
  rl::PathReservoir r{};
  r.path = store.ctx.pathOfLight(light, 7);
  store.ctx.reservoirWriteNow(kSlot, r);
  EXPECT_TRUE(isSame(store.ctx.pathEnd(store.ctx.reservoirReadNow(kSlot).path), light));
}

TEST(ReservoirStore, SpotLightsComeBack) {
  Store store;
  std::vector<rl::Light> table(3);
  table[2].p0 = {1.0f, 2.0f, 3.0f};
  table[2].e1 = {0.6f, 0.0f, 0.8f};
  table[2].e2 = {7.3f, -6.2f, 0.0f};
  store.scene.lights.data = table.data();
  rl::LightSample light{};
  light.kind = rl::RL_LIGHT_SPOT;
  light.point = table[2].p0;
  light.normal = table[2].e1;
  light.radiance = {4.0f, 5.0f, 6.0f};
  light.cone = {7.3f, -6.2f};
  light.record = light.id.instance = 2;
  rl::PathReservoir r{};
  r.path = store.ctx.pathOfLight(light, 7);
  store.ctx.reservoirWriteNow(kSlot, r);
  EXPECT_TRUE(isSame(store.ctx.pathEnd(store.ctx.reservoirReadNow(kSlot).path), light));
}

}  // namespace
}  // namespace restlab::unit
