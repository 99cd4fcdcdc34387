// Paths of restir_gi, shifted to their own pixel (self_shift.h).
#include <gtest/gtest.h>

#include "core/dialect/order.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/unit/self_shift.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every sample
namespace rl::self_shift {

struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_gi/initial.glsl"
};

}  // namespace rl::self_shift

namespace restlab::unit {
namespace {

class SelfShift : public ::testing::TestWithParam<const char*> {};

TEST_P(SelfShift, GivesWhatWasStored) {
  using Context = rl::self_shift::Ctx;
  expectSelfShift<Context, Context>(GetParam(), rl::RL_PATH_RESERVOIR_UVEC4S, 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SelfShift,
                         ::testing::Values("cornell-box", "door-ajar", "glossy-gallery", "glass",
                                           "courtyard", "many-lights"),
                         sceneTestName);

}  // namespace
}  // namespace restlab::unit
