// Body of a generated kernel translation unit: the dialect's functions as members of
// Ctx<features>, Embree behind traceRay(), and the tile loop. The generated file defines
// RL_KERNEL_NAME, RL_KERNEL_HEADER, RL_KERNEL_FILE, RL_KERNEL_TRACE, the file with the body of
// traceRay() (without it, Embree's), and RL_KERNEL_MASKS(M): M(name, features) for each mask.
#include "core/backend/embree.h"

#include "core/backend/trace_callbacks.h"
#include "core/backend/cpu_kernel.h"
#include "core/dialect/order.h"
#include RL_KERNEL_HEADER

// Functions that a kernel hands to the path loop or to the reuse loop have one signature: some
// ignore a parameter.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#ifndef RL_KERNEL_TRACE
#define RL_KERNEL_TRACE "core/backend/cpu_trace.inl"
#endif

namespace rl {
namespace {

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) (++gCounters.health[kind])
#define RL_COUNT_RAY(mode) (++((mode) == RL_RAY_SHADOW ? gCounters.raysShadow : gCounters.raysPath))

template <FeatureMask FEATURES>
struct Ctx {
  static constexpr FeatureMask kFeatures = FEATURES;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;
  RTCScene embreeScene;
  const RL_KERNEL_BUFFERS& gBuffers;
  const RL_KERNEL_PARAMS& gParams;

#include "core/dialect/order.glsl"
#include RL_KERNEL_TRACE
#include RL_KERNEL_FILE
};

template <FeatureMask FEATURES>
void runTile(const CpuKernelArgs& args, const CpuKernelTile& tile, CpuKernelCounters& counters) {
  Ctx<FEATURES> ctx{*args.scene,
                    *args.frame,
                    counters,
                    static_cast<RTCScene>(args.embreeScene),
                    *static_cast<const RL_KERNEL_BUFFERS*>(args.buffers),
                    *static_cast<const RL_KERNEL_PARAMS*>(args.params)};
  for (uint32_t y = tile.y0; y < tile.y1; ++y) {
    for (uint32_t x = tile.x0; x < tile.x1; ++x) ctx.kernelMain(uvec2(x, y));
  }
}

// Inlines every function but those of RL_FN_OUTLINE.
template <FeatureMask FEATURES>
__attribute__((flatten)) void runTileInlined(const CpuKernelArgs& args, const CpuKernelTile& tile,
                                             CpuKernelCounters& counters) {
  runTile<FEATURES>(args, tile, counters);
}

// Kernels without lobes are small: inlined as a whole they are 6 to 9 % faster. Others are not,
// and would take three times as long to compile.
template <FeatureMask FEATURES>
constexpr CpuKernelEntry entryOf() {
  if constexpr ((FEATURES & RL_FEATURE_GLOSSY) == 0u) {
    return runTileInlined<FEATURES>;
  } else {
    return runTile<FEATURES>;
  }
}

}  // namespace

#define RL_KERNEL_ENTRY_OF(kernel, mask, features)      \
  extern const CpuKernelEntry kernel_##kernel##_##mask; \
  const CpuKernelEntry kernel_##kernel##_##mask = entryOf<features>();
#define RL_KERNEL_ENTRY_EXPANDED(kernel, mask, features) RL_KERNEL_ENTRY_OF(kernel, mask, features)
#define RL_KERNEL_ENTRY(mask, features) RL_KERNEL_ENTRY_EXPANDED(RL_KERNEL_NAME, mask, features)
RL_KERNEL_MASKS(RL_KERNEL_ENTRY)

}  // namespace rl
