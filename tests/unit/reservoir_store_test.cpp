// Reservoirs of restir_gi: a pass reads what the pass before has written.
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
  const ReuseBuffers& gBuffers;
  const RestirGiParams& gParams;
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

template <uint32_t FEATURES>
struct Store {
  Store() : ctx{scene, frame, buffers, params, counters} {
    const auto give = [this](rl::Uvec4Ref& ref, uint32_t uvec4s) {
      memory.emplace_back(kSlots * uvec4s, glm::uvec4(0xdeadbeefu));
      ref.data = memory.back().data();
    };
    memory.reserve(16);
    give(buffers.reservoirs, rl::RL_PATH_RESERVOIR_UVEC4S);
    give(buffers.history, rl::RL_PATH_RESERVOIR_UVEC4S);
    give(buffers.suffixes, rl::RL_PATH_SUFFIX_UVEC4S);
    give(buffers.suffixesHistory, rl::RL_PATH_SUFFIX_UVEC4S);
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
  rl::RestirGiParams params{};
  rl::CpuKernelCounters counters;
  rl::StoreCtx<FEATURES> ctx;
};

// Makes a reservoir whose numbers lose nothing by packing: at most 12 bits of fraction, unit
// vectors.
rl::PathReservoir reservoir(float first) {
  const auto vector = [&first](float sign = 1.0f) {
    first += 1.0f;
    return glm::vec3(first, first + 0.25f, sign * (first + 0.5f));
  };
  rl::PathReservoir r{};
  r.path.posW = vector(-1.0f);
  r.path.posError = 0.25f + first / 1024.0f;
  r.path.normalW = glm::normalize(vector(-1.0f));
  r.path.kind = rl::RL_PATH_CONTINUATION;
  r.path.radiance = vector();
  r.path.film = 0x12345678u + uint32_t(first);
  r.path.geometry = 0.1f * first;
  r.path.light = rl::RL_INVALID;
  r.path.suffix.nShadeW = glm::normalize(vector(-1.0f));
  r.path.suffix.pdfLight = 0.7f * first;
  r.path.suffix.wi = glm::normalize(vector());
  r.path.suffix.emitted = vector();
  r.path.suffix.bsdf = {vector(), rl::RL_LOBE_SPECULAR, vector(), 0.75f, vector(), 0.3f, 1.7f};
  r.state.F = vector();
  r.state.W = 0.3f * first;
  r.state.residual = vector(-1.0f);
  r.state.confidence = 1.7f + first;
  return r;
}

constexpr float kUnit = 3e-7f;  // rounding of unit vectors

void expectState(const rl::ReservoirState& read, const rl::ReservoirState& written) {
  EXPECT_TRUE(isSame(read, written));
}
void expectPath(const rl::PathSample& read, const rl::PathSample& written, bool isGlossy) {
  EXPECT_EQ(read.posW, written.posW);
  EXPECT_EQ(read.posError, written.posError);
  EXPECT_LT(glm::distance(read.normalW, written.normalW), kUnit);
  EXPECT_EQ(read.kind, written.kind);
  EXPECT_EQ(read.radiance, written.radiance);
  EXPECT_EQ(read.film, written.film);
  EXPECT_EQ(read.geometry, written.geometry);
  EXPECT_EQ(read.light, written.light);
  const rl::PathSuffix &a = read.suffix, &b = written.suffix;
  if (!isGlossy) {
    EXPECT_TRUE(isSame(a, rl::PathSuffix{}));
    return;
  }
  EXPECT_LT(glm::distance(a.nShadeW, b.nShadeW), kUnit);
  EXPECT_LT(glm::distance(a.wi, b.wi), kUnit);
  EXPECT_EQ(a.pdfLight, b.pdfLight);
  EXPECT_EQ(a.emitted, b.emitted);
  EXPECT_TRUE(isSame(a.bsdf, b.bsdf));
}

template <uint32_t FEATURES>
void expectReservoirs() {
  Store<FEATURES> store;
  auto& c = store.ctx;
  const bool isGlossy = (FEATURES & rl::RL_FEATURE_GLOSSY) != 0;
  const rl::PathReservoir now = reservoir(1.0f), before = reservoir(100.0f);
  c.reservoirWriteNow(kSlot, now);
  c.reservoirWriteHistory(kSlot, before);
  rl::PathReservoir read{};
  c.reservoirReadNow(kSlot, read);
  expectState(read.state, now.state);
  expectPath(read.path, now.path, isGlossy);
  c.reservoirReadPrevious(kSlot, read);
  expectState(read.state, before.state);
  expectPath(read.path, before.path, isGlossy);
  // Writing only the state must leave the path unchanged.
  rl::PathReservoir changed = now;
  changed.state = reservoir(300.0f).state;
  c.stateWriteNow(kSlot, changed);
  expectState(c.stateReadNow(kSlot), changed.state);
  expectState(c.stateReadPrevious(kSlot), before.state);
  c.reservoirReadNow(kSlot, read);
  expectPath(read.path, now.path, isGlossy);
  // Taking only the path must leave the state unchanged.
  c.takeSamplePrevious(kSlot, read);
  expectState(read.state, changed.state);
  expectPath(read.path, before.path, isGlossy);
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

TEST(ReservoirStore, ReservoirsAreReadAsTheyWereWritten) {
  expectReservoirs<rl::RL_FEATURE_ALL>();
  expectReservoirs<0>();
}

// The index of a spot light uses the field that holds the geometry of other paths.
TEST(ReservoirStore, SpotLightsComeBack) {
  Store<0> store;
  rl::PathReservoir written = reservoir(1.0f), read{};
  written.path.kind = rl::RL_PATH_DIRECT | (rl::RL_LIGHT_SPOT << rl::RL_PATH_LIGHT_SHIFT);
  written.path.light = 4711;
  written.path.geometry = written.path.posError = 0.0f;
  store.ctx.reservoirWriteNow(kSlot, written);
  store.ctx.reservoirReadNow(kSlot, read);
  expectPath(read.path, written.path, false);
}

TEST(ReservoirStore, ShiftedSamplesAreReadAsTheyWereWritten) {
  Store<rl::RL_FEATURE_ALL> store;
  store.params.reuse.spatialNeighbours = 1;
  const rl::Shifted written{{0.5f, 3.0f, 0.25f}, 0.3f};
  store.ctx.shiftedWrite(store.ctx.pairedShifts(0), kSlot, written, 77);
  uint32_t partner = 0;
  EXPECT_TRUE(isSame(store.ctx.shiftedRead(store.ctx.pairedShifts(0), kSlot, partner), written));
  EXPECT_EQ(partner, 77u);
  EXPECT_EQ(store.touchedElsewhere(), 0u);
}

// A light stored in a reservoir comes back unchanged.
TEST(ReservoirStore, LightsComeBack) {
  Store<rl::RL_FEATURE_ALL> store;
  std::vector<rl::Light> table(3);
  table[2].e1 = {0.6f, 0.0f, 0.8f};
  table[2].e2 = {7.3f, -6.2f, 0.0f};
  store.scene.lights.data = table.data();
  rl::LightSample light{};
  light.kind = rl::RL_LIGHT_SPOT;
  light.point = {1.0f, 2.0f, 3.0f};
  light.normal = table[2].e1;
  light.radiance = {4.0f, 5.0f, 6.0f};
  light.cone = {7.3f, -6.2f};
  light.record = 2;
  EXPECT_TRUE(isSame(store.ctx.pathLight(store.ctx.pathOfLight(light, 7)), light));
}

}  // namespace
}  // namespace restlab::unit
