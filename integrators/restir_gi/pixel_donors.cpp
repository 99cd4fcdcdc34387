#include "integrators/restir_gi/pixel_donors.h"

#include <algorithm>
#include <utility>

#include "core/backend/alpha_filter.h"
#include "core/backend/cpu_kernel.h"
#include "core/backend/embree.h"
#include "core/reuse/passes.h"
#include "core/scene/compiled/compiled_scene.h"
#include "integrators/restir_gi/snapshot_params.h"
#include "integrators/restir_gi/restir_gi.h"

// Functions that a kernel hands to the reuse loop have one signature: some ignore a parameter.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define RL_HAS(features) ((kFeatures & (features)) != 0u)
#define RL_HEALTH(kind) (++gCounters.health[kind])
#define RL_COUNT_RAY(mode) (++((mode) == RL_RAY_SHADOW ? gCounters.raysShadow : gCounters.raysPath))

namespace rl {

namespace {

using Donors = std::vector<restlab::Donor>;

// Rounding errors of differences: of shares (reservoirs are packed), of sums of confidences.
constexpr double kRoundingOfShares = 1e-3, kRoundingOfConfidence = 1e-4;

// The spatial pass, watched; as in core/backend/cpu_kernel.inl.
#define RL_REUSE_WATCH_CANONICAL(merge, canonical) watchCanonical(merge, canonical);
#define RL_REUSE_WATCH_DONOR(k, donor, shifted, merge, isSelected) \
  watchDonor(state.pixelIndex, k, donor, shifted, merge, isSelected);
namespace over_space {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_gi/spatial.glsl"
#include "integrators/restir_gi/pixel_donors.inl"

  Donors watched_ = {};
  size_t watchedWinner_ = 0;
  real watchedWSum_ = 0.0f;

  void watchCanonical(const MergeState& merge, const ReservoirState& own) {
    restlab::Donor& canonical = watched_.emplace_back();
    canonical.reuse = "own";
    canonical.shift = own.W > 0.0f ? "accepted" : "empty";
    canonical.confidence = own.confidence;
    watchedWSum_ = merge.wSum;
    if (!(own.W > 0.0f)) return;
    canonical.misWeight = merge.mCanonical;
    canonical.share = merge.wSum;
  }
  void watchDonor(uint pixelIndex, uint k, const ReservoirState& donor, const Shifted& here,
                  const MergeState& merge, bool isSelected) {
    const uint neighbour = pairedNeighbour(pixelIndex, k);
    watched_.push_back(asDonor("space", neighbour, donor, here, merge, gParams.reuse.spatialFlags));
    if (!watched_.back().jacobian) {
      const PathReservoir r = reservoirReadNow(neighbour);
      watched_.back().shift = failedTest(r, pixelOfIndex(pixelIndex), r.path.film);
    }
    if (isSelected) watchedWinner_ = watched_.size() - 1;
    watchedWSum_ = merge.wSum;
  }

  Donors overSpace(uvec2 pixel) {
    vec3 estimate;
    spatialMerge(pixelIndexOf(pixel), estimate);
    watched_[0].id = pixelIndexOf(pixel);
    for (restlab::Donor& one : watched_) {
      if (one.share) one.share = misDivide(real(*one.share), watchedWSum_);
    }
    watched_[watchedWinner_].isSelected = watchedWSum_ > 0.0f;
    return watched_;
  }
};
}  // namespace over_space

#undef RL_REUSE_STATE
#undef RL_REUSE_WATCH_CANONICAL
#undef RL_REUSE_WATCH_DONOR

// The initial pass, which finds the pixel's sample of this frame again, and the temporal merge.
namespace over_time {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_gi/initial.glsl"
#include "core/gbuffer/gbuffer_trace.glsl"

  // Traces the surface again: later passes have used the memory of the last frame's.
  GBufferTexel gbufferPrevious(uint pixelIndex) {
    float distanceToCamera;
    return gbufferTrace(gFrame.previousCamera, pixelIndex, distanceToCamera);
  }

#include "core/resampling/reproject.glsl"

  PathReservoir retraceInitialCandidate(uvec2 pixel) {
    vec3 specularLight, visibleEmission;
    PathReservoir r = sampleInitial(pixel, cameraFilmBits(pixel), specularLight, visibleEmission);
    reservoirGuard(r.state);
    return r;
  }

  // Resampling weight of the pixel's own sample, against a donor of `previousPixel`.
  real ownWeight(const PathReservoir& own, uint previousPixel, real cDonor) {
    const bool isStill = gFrame.stillFrames != 0u;
    const uint flags = temporalMergeFlags(isStill);
    MergeState merge = mergeBegin(own.state, cDonor, flags);
    if (!isStill) {
      const bool assumesVisible = (flags & RL_REUSE_ASSUME_VISIBLE) != 0u;
      PathShift shift = shiftTo(own, pixelOfIndex(previousPixel), true, assumesVisible);
      shiftTrace(shift, own);
      mergeWeighCanonical(merge, own.state, cDonor, shift.shifted, flags);
    }
    mergeCanonical(merge, own.state, flags);
    return merge.wSum;
  }

  // `confidence`: of the pixel's reservoir before entries were merged. `isLast`: no entries were
  // merged.
  Donors donors(uvec2 pixel, real confidence, bool isLast) {
    const uint pixelIndex = pixelIndexOf(pixel);
    if (gParams.reuse.temporalReuse == 0u || gFrame.frame == 0u) return {};
    const bool isStill = gFrame.stillFrames != 0u;
    const uint previousPixel =
        isStill ? pixelIndex
        : gParams.reuse.reproject != 0u
            ? reprojectedPixelIndex(gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex))
            : RL_INVALID;
    restlab::Donor donor;
    donor.reuse = "time";
    donor.id = previousPixel;
    // The pixel's sample of this frame has confidence 1: without more, nothing was merged.
    donor.confidence = confidence - 1.0f;
    if (previousPixel == RL_INVALID || !(donor.confidence > kRoundingOfConfidence)) return {};
    const PathReservoir merged = reservoirReadNow(pixelIndex);
    const real wSum = merged.state.W * reuseTarget(merged.state.F);
    const uint film = cameraFilmBits(pixel);
    // Reused samples keep their film sample, and each pixel and frame has another one.
    donor.isSelected = isLast && wSum > 0.0f && merged.path.film != film;
    // Share of the donor: the part of the weights that is not the pixel's own. Unknown if paths end
    // in cells, which have changed since.
    if (isLast && wSum > 0.0f && gParams.cells.count == 0u) {
      const real own =
          ownWeight(retraceInitialCandidate(pixel), previousPixel, real(donor.confidence));
      donor.share = clamp(1.0f - own / wSum, 0.0f, 1.0f);
    }
    // In a still view both samples are of one pixel: the shift is the identity. Otherwise the shift
    // was accepted if the share exceeds the rounding of packing.
    donor.shift =
        isStill || donor.share.value_or(0.0) > kRoundingOfShares ? "accepted" : "not kept";
    if (isStill) donor.misWeight = donor.confidence / confidence;
    return {donor};
  }
};
}  // namespace over_time

#undef RL_REUSE_STATE

// The cache_reuse pass.
namespace of_entries {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include "integrators/restir_gi/cache_reuse.glsl"
#include "integrators/restir_gi/pixel_donors.inl"

  Donors ofEntries(uvec2 pixel) {
    const uint flags = gParams.reuse.spatialFlags, count = gParams.entries.proposals;
    CacheMerge s;
    if (gFrame.stillFrames != 0u || !findEntries(s, pixelIndexOf(pixel), count)) return {};
    const PathReservoir now = reservoirReadNow(s.owner);
    s.rng = rngInit(gFrame.seed, s.owner, gFrame.frame);
    s.rng.vertex = RL_VERTEX_CACHE_REUSE;
    const uint film = rngBits(s.rng, RL_DIM_FILTER_X);
    shiftEntries(s, now, pixel, film, count);
    ReservoirState donor = now.state, canonical = now.state;
    const real cDonors = confidenceOf(s, count);
    canonical.confidence -= cDonors;
    const MergeState merge = mergeBegin(canonical, cDonors, flags);
    const real wSum = now.state.W * reuseTarget(now.state.F);
    const bool isSelected = wSum > 0.0f && now.path.film == film;
    Donors all;
    real nearest = 0.0f;
    size_t winner = 0;
    for (uint k = 0; k < count; ++k) {
      if (!reuseDonor(s, k, donor)) continue;
      all.push_back(asDonor("entry", s.donorId[k], donor, s.neighbourAtCanonical[k], merge, flags));
      restlab::Donor& one = all.back();
      if (one.share) one.share = misDivide(real(*one.share), wSum);
      if (!one.jacobian) {
        one.shift = failedTest(entryReservoirRead(s.donorId[k]), pixel, film);
      }
      // Select the donor whose integrand is the pixel's, up to rounding.
      const real off = length(s.neighbourAtCanonical[k].F - now.state.F);
      if (all.size() == 1 || off < nearest) {
        nearest = off;
        winner = all.size() - 1;
      }
    }
    if (isSelected && !all.empty()) all[winner].isSelected = true;
    return all;
  }
};
}  // namespace of_entries

Donors donorsOf(const restlab::FrameSnapshot& snapshot, const ReuseBuffers& buffers,
                const PathReuseParams& params, uvec2 pixel) {
  CpuKernelCounters counters;
  const SceneData& scene = snapshot.scene->data();
  const auto rays = static_cast<RTCScene>(snapshot.scene->embreeScene());
  over_space::Ctx space{scene, *snapshot.frame, counters, rays, buffers, params};
  over_time::Ctx time{scene, *snapshot.frame, counters, rays, buffers, params};
  of_entries::Ctx entries{scene, *snapshot.frame, counters, rays, buffers, params};
  Donors all = space.overSpace(pixel), ofEntries;
  if (params.entries.count != 0u) ofEntries = entries.ofEntries(pixel);
  double confidence = all.front().confidence;
  for (const restlab::Donor& one : ofEntries) confidence -= one.confidence;
  for (const restlab::Donor& one : time.donors(pixel, float(confidence), ofEntries.empty()))
    all.push_back(one);
  all.insert(all.end(), ofEntries.begin(), ofEntries.end());
  return all;
}

}  // namespace

}  // namespace rl

namespace restlab {

namespace {

// Binds a buffer. Kernels only read it, so a copy that nobody writes to may be bound.
template <typename Ref>
void bindCopy(const FrameSnapshot& snapshot, const std::string& name, Ref& ref) {
  const std::span<const uint32_t> words = snapshot.words(name);
  ref.data = words.empty()
                 ? nullptr
                 : reinterpret_cast<decltype(ref.data)>(const_cast<uint32_t*>(words.data()));
}

}  // namespace

std::vector<Donor> giDonorsOf(const FrameSnapshot& snapshot, size_t pixel) {
  if (snapshot.frame == nullptr || snapshot.scene == nullptr) return {};
  rl::ReuseBuffers buffers{};
  bindCopy(snapshot, "gbuffer", buffers.gbuffer);
  bindCopy(snapshot, "proposals", buffers.proposals);
  bindCopy(snapshot, "shading_points", buffers.shadingPoints);
  bindCopy(snapshot, "changes", buffers.changes);
  bindCopy(snapshot, "reservoirs", buffers.reservoirs);
  bindCopy(snapshot, pairedShiftsName(0), buffers.pairedShifts0);
  bindCopy(snapshot, pairedShiftsName(1), buffers.pairedShifts1);
  bindCopy(snapshot, pairedShiftsName(2), buffers.pairedShifts2);
  bindCopy(snapshot, pairedShiftsName(3), buffers.pairedShifts3);
  bindCopy(snapshot, "entry_reservoirs", buffers.entryReservoirs);
  const rl::uvec2 at(pixel % snapshot.frame->width, pixel / snapshot.frame->width);
  return rl::donorsOf(snapshot, buffers, giParamsOf(snapshot), at);
}

}  // namespace restlab
