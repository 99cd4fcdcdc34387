// Shifts a path, after packing and unpacking, to its own pixel: the result must be the integrand
// that the initial pass stored, and Jacobian 1. Included after a method's header.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/builtin/scenes.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/unit/dialect_context.h"

namespace restlab::unit {

// The scene as a test's name may hold it.
inline std::string sceneTestName(const ::testing::TestParamInfo<const char*>& instance) {
  std::string name = instance.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Initial, Shift: kernel contexts over the passes `initial` and `spatial_shift` of a method.
template <class Initial, class Shift>
void expectSelfShift(const std::string& sceneName, uint32_t uvec4s, uint32_t lightCandidates) {
  constexpr uint32_t kWidth = 48, kHeight = 32;
  const auto scene = CompiledScene::build(makeBuiltinScene(sceneName));
  rl::SceneData data = scene->data();
  rl::FrameData frame{};
  frame.width = kWidth;
  frame.height = kHeight;
  frame.camera = scene->camera(scene->source().cameras.front(), kWidth, kHeight);
  frame.maxBounces = 6;
  frame.components = rl::RL_COMPONENT_ALL;
  frame.rouletteStart = rl::RL_INVALID;
  frame.seed = 5;
  rl::PathReuseParams params{};
  params.path = {lightCandidates, 0.04f, 100.0f, 0, rl::RL_PATH_MOST_REPLAYED, 2e-4f};
  std::vector<glm::uvec4> words(uvec4s);
  rl::ReuseBuffers buffers{};
  buffers.reservoirs.data = words.data();
  rl::CpuKernelCounters counters;
  const auto embree = static_cast<RTCScene>(scene->embreeScene());
  Shift shifts{data, frame, counters, embree, buffers, params};
  Initial c{data, frame, counters, embree, buffers, params};
  size_t tested = 0, rounded = 0, different = 0;
  for (frame.frame = 0; frame.frame < 4; ++frame.frame) {
    for (uint32_t slot = 0; slot < kWidth * kHeight; ++slot) {
      const rl::uvec2 pixel(slot % kWidth, slot / kWidth);
      glm::vec3 specular, visible;
      c.reservoirWriteNow(0, c.sampleInitial(pixel, c.cameraFilmBits(pixel), specular, visible));
      const rl::PathReservoir r = c.reservoirReadNow(0);
      if (!(r.state.W > 0.0f)) continue;
      rl::PathShift shift = shifts.pathShiftTo(r, pixel, false, false);
      shifts.pathShiftTrace(shift, r.path);
      const glm::vec3 stored = r.state.F, shifted = shift.shifted.F;
      const float off = glm::length(shifted - stored) / glm::length(stored);
      ++tested;
      rounded += off > 2e-3f ? 1 : 0;
      different += !(off < 2e-2f) || std::abs(shift.shifted.jacobian - 1.0f) > 1e-3f ? 1 : 0;
    }
  }
  std::printf("  %s: of %zu %zu differ, %zu are rounded\n", sceneName.c_str(), tested, different,
              rounded);
  EXPECT_GT(tested, 500u);
  // A path ray and a connection to its end point differ by rounding: at edges in visibility, in
  // corners and at nearly smooth x2 in direction.
  EXPECT_LE(different, tested / 500);
  EXPECT_LE(rounded, tested / 100);
}

}  // namespace restlab::unit
