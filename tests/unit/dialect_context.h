// The dialect's functions for tests, as in a kernel: members of rl::Ctx<features>, with the scene's
// own Embree structure behind traceRay().
#pragma once

#include <memory>

#include "core/backend/trace_callbacks.h"
#include "core/backend/cpu_kernel.h"
#include "core/backend/embree.h"
#include "core/dialect/order.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/compiled/ggx_albedo.h"

#ifdef RL_RNG_AUDIT
#error "rl::Ctx would differ between the files of the program"
#endif
#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) (++gCounters.health[kind])
#define RL_COUNT_RAY(mode) (++((mode) == RL_RAY_SHADOW ? gCounters.raysShadow : gCounters.raysPath))

namespace rl {

template <FeatureMask FEATURES>
struct Ctx {
  static constexpr FeatureMask kFeatures = FEATURES;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;
  RTCScene embreeScene;

#include "core/dialect/order.glsl"
// traceRay(); after the functions that its filters call.
#include "core/backend/cpu_trace.inl"
};

}  // namespace rl

namespace restlab::unit {

// A receiver for draws that do not depend on one: light arrives from everywhere.
inline rl::LightReceiver anyReceiver() {
  return {glm::vec3(0.0f), 1u, glm::vec3(0.0f, 0.0f, 1.0f)};
}

// A kernel context with the storage that it refers to. Without a compiled scene, tests fill `scene`
// by hand and must trace no rays.
template <rl::FeatureMask FEATURES = rl::RL_FEATURE_ALL>
struct Dialect {
  Dialect() : ctx{scene, frame, counters, nullptr} {}
  explicit Dialect(std::shared_ptr<const CompiledScene> compiled)
      : compiledScene(std::move(compiled)),
        scene(compiledScene->data()),
        ctx{scene, frame, counters, static_cast<RTCScene>(compiledScene->embreeScene())} {}
  Dialect(const Dialect&) = delete;
  Dialect& operator=(const Dialect&) = delete;

  rl::Ctx<FEATURES>* operator->() { return &ctx; }

  // Switches multiple-scattering compensation on, as a session does.
  void compensate() {
    scene.ggxAlbedo.data = const_cast<glm::vec2*>(ggxAlbedoTable().data());
    frame.multiscatter = 1;
  }

  std::shared_ptr<const CompiledScene> compiledScene;
  rl::SceneData scene{};
  rl::FrameData frame{};
  rl::CpuKernelCounters counters;
  rl::Ctx<FEATURES> ctx;
};

}  // namespace restlab::unit
