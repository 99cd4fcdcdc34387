#include "integrators/restir_gi/pixel_own.h"

#include <embree3/rtcore.h>

#include "core/backend/alpha_filter.h"
#include "core/backend/cpu_kernel.h"
#include "core/scene/compiled_scene.h"

// Functions that a kernel hands to the path loop have one signature: some ignore a parameter.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) (++gCounters.health[kind])
#define RL_COUNT_RAY(mode) (++((mode) == RL_RAY_SHADOW ? gCounters.raysShadow : gCounters.raysPath))

namespace rl {

namespace {

// As in core/backend/cpu_kernel.inl: the initial pass, and the shift of the temporal one.
template <uint FEATURES>
struct Ctx {
  static constexpr uint kFeatures = FEATURES;

  const SceneData& gScene;
  const FrameData& gFrame;
  CpuKernelCounters& gCounters;
  RTCScene embreeScene;
  const RestirGiBuffers& gBuffers;
  const RestirGiParams& gParams;

#include "core/dialect/order.glsl"
#include "core/backend/cpu_trace.inl"
#include "integrators/restir_gi/initial.glsl"
#include "core/payload/path_shift.glsl"

  // As kernelMain() of the initial pass begins.
  PathReservoir traced(uvec2 pixel) {
    const uint slot = slotOfPixel(pixel), film = cameraFilmBits(pixel);
    PathGather p = pathNothingGathered(film);
    p.end = radianceBegin(slot);
    walkPath(p, pixel, film);
    PathReservoir r = pathResample(p, rngInit(gFrame.seed, slot, gFrame.frame));
    reservoirGuard(r.state);
    return r;
  }

  // As giMergeStillView() and the temporal pass weigh it.
  real ownWeight(uvec2 pixel, uint before, real cDonor) {
    const PathReservoir r = traced(pixel);
    const bool isStill = gFrame.stillFrames != 0u;
    const uint flags = isStill ? gParams.temporalFlags & ~RL_REUSE_PAIRWISE : gParams.temporalFlags;
    MergeState merge = mergeBegin(r.state, cDonor, flags);
    if (!isStill) {
      PathShift shift =
          pathShiftTo(r, pixelOfSlot(before), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
      pathShiftTrace(shift, r.path);
      mergeWeighCanonical(merge, r.state, cDonor, shift.shifted, flags);
    }
    mergeCanonical(merge, r.state, flags);
    return merge.wSum;
  }
};

}  // namespace

}  // namespace rl

namespace restlab {

std::optional<float> giOwnWeightOverTime(const Kept& kept, const rl::RestirGiBuffers& buffers,
                                         const rl::RestirGiParams& params, rl::uvec2 pixel,
                                         uint32_t before, float cDonor) {
  if (params.cells.count != 0u) return std::nullopt;
  rl::CpuKernelCounters counters;
  rl::Ctx<rl::RL_FEATURE_ALL> context{kept.scene->data(),
                                      *kept.frame,
                                      counters,
                                      static_cast<RTCScene>(kept.scene->embreeScene()),
                                      buffers,
                                      params};
  return context.ownWeight(pixel, before, cDonor);
}

}  // namespace restlab
