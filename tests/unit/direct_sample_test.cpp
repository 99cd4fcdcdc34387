// Points of lights as restir_di resamples them: what 32 bytes hold, and the shift to the pixel
// itself (self_shift.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dialect/order.h"
#include "integrators/restir_di/restir_di.h"
#include "tests/unit/random_inputs.h"
#include "tests/unit/self_shift.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
namespace rl::direct_sample {

struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_di/initial.glsl"
};

}  // namespace rl::direct_sample

namespace restlab::unit {
namespace {

using Context = rl::direct_sample::Ctx;

// One reservoir, and a light table of one of each kind that a path can end at.
struct Store {
  Store() : c{scene, frame, counters, nullptr, buffers, params} {
    lights[0].kind = rl::RL_LIGHT_AREA;
    lights[1].kind = rl::RL_LIGHT_SPOT;
    lights[2].kind = rl::RL_LIGHT_ENVIRONMENT;
    scene.lights.data = lights.data();
    scene.environmentLight = 2;
    buffers.reservoirs.data = words.data();
    buffers.history.data = others.data();
  }
  std::vector<rl::Light> lights{3};
  std::vector<glm::uvec4> words{rl::RL_DIRECT_RESERVOIR_UVEC4S};
  std::vector<glm::uvec4> others{rl::RL_DIRECT_RESERVOIR_UVEC4S};
  rl::SceneData scene{};
  rl::FrameData frame{};
  rl::ReuseBuffers buffers{};
  rl::PathReuseParams params{};
  rl::CpuKernelCounters counters;
  Context c;
};

rl::PathReservoir reservoirOf(Store& store, uint32_t light, Inputs& inputs) {
  rl::LightSample drawn{};
  drawn.record = light;
  drawn.kind = store.lights[light].kind;
  drawn.id.bary = {inputs.uniform(0.0f, 1.0f), inputs.uniform(0.0f, 1.0f)};
  drawn.point = inputs.direction();
  rl::PathReservoir r{};
  r.path = store.c.pathOfLight(drawn, 0x9abcdef0u ^ light);
  r.state.F = {inputs.scale(1e-3f, 1e3f), inputs.scale(1e-3f, 1e3f), inputs.scale(1e-3f, 1e3f)};
  r.state.residual = inputs.scale(1e-3f, 1e3f) * inputs.direction();
  r.state.W = inputs.scale(1e-6f, 1e6f);
  r.state.confidence = inputs.uniform(0.0f, 500.0f);
  return r;
}

float greatest(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// A light is evaluated from the start at the point that the words give.
TEST(DirectSample, ComesBackFromItsWords) {
  Store store;
  Inputs inputs(3);
  constexpr float kStep = 1.0f / float(rl::RL_DIRECT_GRID), kPacked = 2.5e-4f;
  for (int i = 0; i < 30'000; ++i) {
    const rl::PathReservoir r = reservoirOf(store, uint32_t(i % 3), inputs);
    store.c.reservoirWriteNow(0, r);
    const rl::PathReservoir read = store.c.reservoirReadNow(0);
    ASSERT_EQ(read.path.id.instance, r.path.id.instance);
    ASSERT_EQ(read.path.id.bary, r.path.id.bary);
    ASSERT_EQ(read.path.kind, r.path.kind);
    ASSERT_EQ(read.path.film, r.path.film);
    ASSERT_EQ(read.path.wi, r.path.wi);
    ASSERT_EQ(read.state.W, r.state.W);
    ASSERT_EQ(read.state.confidence, r.state.confidence);
    ASSERT_LE(greatest(read.state.F - r.state.F), kPacked * greatest(r.state.F));
    ASSERT_LE(greatest(read.state.residual - r.state.residual),
              kPacked * greatest(r.state.residual));
    ASSERT_EQ(store.c.stateReadNow(0).F, read.state.F);
    ASSERT_EQ(store.c.stateReadNow(0).residual, read.state.residual);
  }
  // Half a step at most is lost of a drawn point, and of a direction what that makes of it.
  rl::LightSample drawn{};
  drawn.kind = rl::RL_LIGHT_AREA;
  drawn.id.bary = {0.3f, 1.0f};
  EXPECT_LE(std::abs(store.c.pathOfLight(drawn, 0).id.bary.x - 0.3f), 0.51f * kStep);
  EXPECT_EQ(store.c.pathOfLight(drawn, 0).id.bary.y, 1.0f);
  drawn.kind = rl::RL_LIGHT_ENVIRONMENT;
  drawn.record = 2;
  for (int i = 0; i < 10'000; ++i) {
    drawn.point = inputs.direction();
    ASSERT_LE(glm::distance(store.c.pathOfLight(drawn, 0).wi, drawn.point), 5.0f * kStep);
  }
}

// The light of an empty reservoir is not looked up: there may be no light table.
TEST(DirectSample, AnEmptyReservoirNamesNoLight) {
  Store store;
  store.scene.lights.data = nullptr;
  rl::PathReservoir r{};
  r.path = store.c.pathOfLight(store.c.pathNoLight(), 7);
  r.state = store.c.reservoirEmpty();
  store.c.reservoirWriteNow(0, r);
  const rl::PathReservoir read = store.c.reservoirReadNow(0);
  EXPECT_EQ(read.state.W, 0.0f);
  EXPECT_EQ(read.path.film, 7u);
}

class DirectSelfShift : public ::testing::TestWithParam<const char*> {};

TEST_P(DirectSelfShift, GivesWhatWasStored) {
  expectSelfShift<Context, Context>(GetParam(), rl::RL_DIRECT_RESERVOIR_UVEC4S, 8);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DirectSelfShift,
                         ::testing::Values("cornell-box", "glossy-gallery", "courtyard",
                                           "many-lights"),
                         sceneTestName);

}  // namespace
}  // namespace restlab::unit
