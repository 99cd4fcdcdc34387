// Paths of restir_pt: what 64 bytes hold, and the shift to the pixel itself (self_shift.h),
// replayed and reconnected.
#include <gtest/gtest.h>

#include <vector>

#include "core/dialect/order.h"
#include "integrators/restir_pt/restir_pt.h"
#include "tests/unit/random_inputs.h"
#include "tests/unit/self_shift.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
// The pass that finds paths, and one that shifts them: each has a walk of its own.
namespace rl::replay_sample::initial {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_pt/initial.glsl"
};
}  // namespace rl::replay_sample::initial

#undef RL_WALK_STATE
#undef RL_WALK_END
#undef RL_REUSE_STATE
namespace rl::replay_sample::shift {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_pt/spatial_shift.glsl"
};
}  // namespace rl::replay_sample::shift

namespace restlab::unit {
namespace {

TEST(ReplaySample, ComesBackFromItsWords) {
  rl::SceneData scene{};
  rl::FrameData frame{};
  rl::ReuseBuffers buffers{};
  rl::PathReuseParams params{};
  rl::CpuKernelCounters counters;
  std::vector<glm::uvec4> words(rl::RL_PATH_RESERVOIR_UVEC4S);
  buffers.reservoirs.data = words.data();
  rl::replay_sample::initial::Ctx c{scene, frame, counters, nullptr, buffers, params};
  Inputs inputs(5);
  const auto colour = [&] {
    return glm::vec3(inputs.scale(1e-3f, 1e3f), inputs.scale(1e-3f, 1e3f),
                     inputs.scale(1e-3f, 1e3f));
  };
  for (uint32_t i = 0; i < 10'000; ++i) {
    rl::PathReservoir r{};
    r.path.id = {inputs.bits(), inputs.bits(), inputs.square()};
    r.path.kind = i % 7 | rl::RL_PATH_BACK;
    r.path.film = inputs.bits();
    r.path.key = inputs.bits();
    r.path.base = i % (rl::RL_PATH_MOST_REPLAYED + 1);
    r.path.radiance = colour();
    r.path.geometry = inputs.scale(1e-6f, 1e6f);
    r.path.wi = c.pathPackedWi(inputs.direction());
    r.path.pdfLight = c.pathPackedPdf(inputs.scale(1e-3f, 1e3f));
    r.state = {colour(), inputs.scale(1e-3f, 1e3f), inputs.uniform() * inputs.direction(),
               inputs.uniform(0.0f, 500.0f)};
    c.reservoirWriteNow(0, r);
    const rl::PathReservoir read = c.reservoirReadNow(0);
    ASSERT_EQ(read.path.id.instance, r.path.id.instance);
    ASSERT_EQ(read.path.id.primitive, r.path.id.primitive);
    ASSERT_LE(glm::distance(read.path.id.bary, r.path.id.bary), 1e-7f);
    ASSERT_EQ(read.path.kind, r.path.kind);
    ASSERT_EQ(read.path.film, r.path.film);
    ASSERT_EQ(read.path.key, r.path.key);
    ASSERT_EQ(read.path.base, r.path.base);
    ASSERT_EQ(read.path.wi, r.path.wi);
    ASSERT_EQ(read.path.pdfLight, r.path.pdfLight);
    ASSERT_NEAR(read.path.geometry / r.path.geometry, 1.0f, 1.3e-4f);
    ASSERT_LE(glm::distance(read.path.radiance, r.path.radiance),
              7e-5f * glm::length(r.path.radiance));
    ASSERT_LE(glm::distance(read.state.F, r.state.F), 7e-5f * glm::length(r.state.F));
    ASSERT_EQ(read.state.W, r.state.W);
    ASSERT_EQ(read.state.confidence, r.state.confidence);
    ASSERT_LE(glm::distance(read.state.residual, r.state.residual),
              5e-4f * glm::length(r.state.residual));
    ASSERT_EQ(c.stateReadNow(0).residual, read.state.residual);
  }
}

class ReplaySelfShift : public ::testing::TestWithParam<const char*> {};

TEST_P(ReplaySelfShift, GivesWhatWasStored) {
  expectSelfShift<rl::replay_sample::initial::Ctx, rl::replay_sample::shift::Ctx>(
      GetParam(), rl::RL_PATH_RESERVOIR_UVEC4S, 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReplaySelfShift,
                         ::testing::Values("cornell-box", "door-ajar", "glossy-gallery", "glass",
                                           "courtyard", "many-lights"),
                         sceneTestName);

}  // namespace
}  // namespace restlab::unit
