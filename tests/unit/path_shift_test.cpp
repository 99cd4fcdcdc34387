// Shifts a path, after packing and unpacking, to its own pixel: the result must be the integrand
// that the initial pass stored, and Jacobian 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/dialect/order.h"
#include "core/scene/builtin/scenes.h"
#include "integrators/restir_gi/restir_gi.h"
#include "tests/unit/dialect_context.h"

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
  const RestirGiParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"
#include "integrators/restir_gi/initial.glsl"
};

}  // namespace rl::self_shift

namespace restlab::unit {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 32;

class SelfShift : public ::testing::TestWithParam<const char*> {
 protected:
  SelfShift() : scene_(CompiledScene::build(makeBuiltinScene(GetParam()))), data_(scene_->data()) {
    frame_.width = kWidth;
    frame_.height = kHeight;
    frame_.camera = scene_->camera(scene_->source().cameras.front(), kWidth, kHeight);
    frame_.maxBounces = 6;
    frame_.components = rl::RL_COMPONENT_ALL;
    frame_.rouletteStart = rl::RL_INVALID;
    frame_.seed = 5;
    params_.path = {1, 0.04f, 100.0f};
    uvec4s_.resize(rl::RL_PATH_RESERVOIR_UVEC4S);
    buffers_.reservoirs.data = uvec4s_.data();
  }

  std::shared_ptr<const CompiledScene> scene_;
  rl::SceneData data_;
  rl::FrameData frame_{};
  rl::ReuseBuffers buffers_{};
  rl::RestirGiParams params_{};
  rl::CpuKernelCounters counters_;
  std::vector<glm::uvec4> uvec4s_;
};

TEST_P(SelfShift, GivesWhatWasStored) {
  rl::self_shift::Ctx<rl::RL_FEATURE_ALL> c{
      data_, frame_, counters_, static_cast<RTCScene>(scene_->embreeScene()), buffers_, params_};
  size_t tested = 0, rounded = 0, different = 0;
  for (frame_.frame = 0; frame_.frame < 4; ++frame_.frame) {
    for (uint32_t slot = 0; slot < kWidth * kHeight; ++slot) {
      const rl::uvec2 pixel(slot % kWidth, slot / kWidth);
      rl::PathRecord path = c.pathRecordEmpty(c.cameraFilmBits(pixel));
      c.walkPath(path, pixel, path.film);
      c.reservoirWriteNow(0, c.pathResample(path, c.rngInit(frame_.seed, slot, frame_.frame)));
      const rl::PathReservoir r = c.reservoirReadNow(0);
      if (!(r.state.W > 0.0f)) continue;
      rl::PathShift shift = c.pathShiftTo(r, pixel, false, false);
      c.pathShiftTrace(shift, r.path);
      const glm::vec3 stored = r.state.F, shifted = shift.shifted.F;
      const float off = glm::length(shifted - stored) / glm::length(stored);
      ++tested;
      rounded += off > 2e-3f ? 1 : 0;
      different += !(off < 2e-2f) || std::abs(shift.shifted.jacobian - 1.0f) > 1e-3f ? 1 : 0;
    }
  }
  std::printf("  %s: of %zu %zu differ, %zu are rounded\n", GetParam(), tested, different, rounded);
  EXPECT_GT(tested, 500u);
  // A path ray and a connection to its end point differ by rounding: at edges in visibility, in
  // corners and at nearly smooth x2 in direction.
  EXPECT_LE(different, tested / 500);
  EXPECT_LE(rounded, tested / 100);
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
