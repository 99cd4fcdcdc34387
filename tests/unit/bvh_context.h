// The dialect's functions with traceRay() through the project's own hierarchy.
#pragma once

#include "tests/unit/dialect_context.h"

namespace rl {

struct BvhCtx {
  static constexpr FeatureMask kFeatures = RL_FEATURE_ALL;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;

#include "core/dialect/order.glsl"
#include "core/geometry/trace_bvh.glsl"
};

}  // namespace rl
