// Paths of restir_gi, shifted to their own pixel (self_shift.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/dialect/order.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/unit/self_shift.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"  // one signature for every payload
namespace rl::self_shift {

template <uint FEATURES>
struct Ctx {
  static constexpr uint kFeatures = FEATURES;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;
  RTCScene embreeScene;
  const ReuseBuffers& gBuffers;
  const PathReuseParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"
#include "integrators/restir_gi/initial.glsl"
};

}  // namespace rl::self_shift

namespace restlab::unit {
namespace {

class SelfShift : public ::testing::TestWithParam<const char*> {};

TEST_P(SelfShift, GivesWhatWasStored) {
  using Context = rl::self_shift::Ctx<rl::RL_FEATURE_ALL>;
  expectSelfShift<Context, Context>(GetParam(), rl::RL_PATH_RESERVOIR_UVEC4S, 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SelfShift,
                         ::testing::Values("cornell-box", "door-ajar", "glossy-gallery", "glass",
                                           "courtyard", "many-lights"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace restlab::unit
