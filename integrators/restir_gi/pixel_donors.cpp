#include "integrators/restir_gi/pixel_donors.h"

#include <algorithm>
#include <utility>

#include "core/backend/alpha_filter.h"
#include "core/backend/cpu_kernel.h"
#include "core/backend/embree.h"
#include "core/scene/compiled/compiled_scene.h"
#include "integrators/restir_gi/kept_params.h"
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

// The spatial pass, with the shifts of the spatial_shift pass; as in core/backend/cpu_kernel.inl.
namespace over_space {
template <uint FEATURES>
struct Ctx {
#include "integrators/restir_gi/pixel_context.inl"
#include "integrators/restir_gi/spatial.glsl"
#include "integrators/restir_gi/pixel_donors.inl"

  // The merge of core/resampling/reuse.glsl, step by step.
  Donors overSpace(uvec2 pixel) {
    const uint flags = gParams.reuse.spatialFlags;
    SpatialMerge s;
    s.pixelIndex = pixelIndexOf(pixel);
    s.share = reuseDonorShare(historyAge(), gParams.reuse.donorNoise);
    s.rng = rngInit(gFrame.seed, s.pixelIndex, gFrame.frame);
    s.rng.vertex = RL_VERTEX_SPATIAL;
    const ReservoirState own = reservoirOf(s.pixelIndex).state;
    const uint count = spatialDonors();
    ReservoirState donor = own, selected = own;
    MergeState merge = mergeBegin(own, confidenceOf(s, count), flags);
    for (uint k = 0; k < count; ++k) {
      if (reuseDonor(s, k, donor))
        mergeWeighCanonical(merge, own, donor.confidence, reuseCanonicalAtNeighbour(s, k), flags);
    }
    mergeCanonical(merge, own, flags);
    Donors all(1);
    all[0].reuse = "own";
    all[0].id = s.pixelIndex;
    all[0].shift = own.W > 0.0f ? "accepted" : "empty";
    all[0].confidence = own.confidence;
    if (own.W > 0.0f) {
      all[0].misWeight = merge.mCanonical;
      all[0].share = merge.wSum;
    }
    size_t winner = 0;
    for (uint k = 0; k < count; ++k) {
      if (!reuseDonor(s, k, donor)) continue;
      const Shifted here = reuseNeighbourAtCanonical(s, k);
      const uint neighbour = pairedNeighbour(s.pixelIndex, k);
      all.push_back(asDonor("space", neighbour, donor, here, merge, flags));
      if (!all.back().jacobian) {
        const PathReservoir r = reservoirOf(neighbour);
        all.back().shift = failedTest(r, pixel, r.path.film);
      }
      if (mergeDonor(merge, selected, donor, here, reuseRatio(s, k), flags, reuseUniform(s, k)))
        winner = all.size() - 1;
    }
    for (restlab::Donor& one : all) {
      if (one.share) one.share = misDivide(real(*one.share), merge.wSum);
    }
    all[winner].isSelected = merge.wSum > 0.0f;
    return all;
  }
};
}  // namespace over_space

#undef RL_REUSE_STATE

// The initial pass, which finds the pixel's sample of this frame again, and the temporal merge.
namespace over_time {
template <uint FEATURES>
struct Ctx {
#include "integrators/restir_gi/pixel_context.inl"
#include "integrators/restir_gi/initial.glsl"
#include "core/resampling/reproject.glsl"

  PathReservoir found(uvec2 pixel) {
    vec3 unresampled, inView;
    PathReservoir r = sampleInitial(pixel, cameraFilmBits(pixel), unresampled, inView);
    reservoirGuard(r.state);
    return r;
  }

  // Resampling weight of the pixel's own sample, against a donor of the pixel `before`.
  real ownWeight(const PathReservoir& own, uint before, real cDonor) {
    const bool isStill = gFrame.stillFrames != 0u;
    const uint flags =
        isStill ? gParams.reuse.temporalFlags & ~RL_REUSE_PAIRWISE : gParams.reuse.temporalFlags;
    MergeState merge = mergeBegin(own.state, cDonor, flags);
    if (!isStill) {
      const bool assumesVisible = (flags & RL_REUSE_ASSUME_VISIBLE) != 0u;
      PathShift shift = shiftTo(own, pixelOfIndex(before), true, assumesVisible);
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
    const uint before = isStill                         ? pixelIndex
                        : gParams.reuse.reproject != 0u ? reprojectedPixelIndex(pixelIndex)
                                                        : RL_INVALID;
    restlab::Donor donor;
    donor.reuse = "time";
    donor.id = before;
    // The pixel's sample of this frame has confidence 1: without more, nothing was merged.
    donor.confidence = confidence - 1.0f;
    if (before == RL_INVALID || !(donor.confidence > kRoundingOfConfidence)) return {};
    const PathReservoir merged = reservoirOf(pixelIndex);
    const real wSum = merged.state.W * reuseTarget(merged.state.F);
    const uint film = cameraFilmBits(pixel);
    // Reused samples keep their film sample, and each pixel and frame has another one.
    donor.isSelected = isLast && wSum > 0.0f && merged.path.film != film;
    // Share of the donor: the part of the weights that is not the pixel's own. Unknown if paths end
    // in cells, which have changed since.
    if (isLast && wSum > 0.0f && gParams.cells.count == 0u) {
      const real own = ownWeight(found(pixel), before, real(donor.confidence));
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
template <uint FEATURES>
struct Ctx {
#include "integrators/restir_gi/pixel_context.inl"
#include "integrators/restir_gi/cache_reuse.glsl"
#include "integrators/restir_gi/pixel_donors.inl"

  Donors ofEntries(uvec2 pixel) {
    const uint flags = gParams.reuse.spatialFlags, count = gParams.entries.proposals;
    CacheMerge s;
    s.pixelIndex = pixelIndexOf(pixel);
    if (gFrame.stillFrames != 0u || gParams.reuse.temporalReuse == 0u ||
        !(historyWeight(s.pixelIndex) > 0.0f))
      return {};
    bool isAsked = false;
    for (uint k = 0; k < count; ++k) {
      s.id[k] = gBuffers.proposals.data[s.pixelIndex * count + k];
      if (s.id[k] == RL_INVALID) continue;
      const ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, s.id[k]);
      if (shadingPoint.surface.isHit == 0u || shadingPoint.sourcePixel == s.pixelIndex)
        s.id[k] = RL_INVALID;
      isAsked = isAsked || s.id[k] != RL_INVALID;
    }
    if (!isAsked) return {};
    const PathReservoir now = reservoirOf(s.pixelIndex);
    s.rng = rngInit(gFrame.seed, s.pixelIndex, gFrame.frame);
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
      all.push_back(asDonor("entry", s.id[k], donor, s.neighbourAtCanonical[k], merge, flags));
      restlab::Donor& one = all.back();
      if (one.share) one.share = misDivide(real(*one.share), wSum);
      if (!one.jacobian) {
        PathReservoir r = now;
        entryReservoirRead(s.id[k], r);
        one.shift = failedTest(r, pixel, film);
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

template <uint FEATURES>
Donors donorsOf(const restlab::FrameSnapshot& kept, const ReuseBuffers& buffers,
                const RestirGiParams& params, uvec2 pixel) {
  CpuKernelCounters counters;
  const SceneData& scene = kept.scene->data();
  const auto rays = static_cast<RTCScene>(kept.scene->embreeScene());
  over_space::Ctx<FEATURES> space{scene, *kept.frame, counters, rays, buffers, params};
  over_time::Ctx<FEATURES> time{scene, *kept.frame, counters, rays, buffers, params};
  of_entries::Ctx<FEATURES> entries{scene, *kept.frame, counters, rays, buffers, params};
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
void bind(const FrameSnapshot& kept, const std::string& name, Ref& ref) {
  const std::span<const uint32_t> words = kept.words(name);
  ref.data = words.empty()
                 ? nullptr
                 : reinterpret_cast<decltype(ref.data)>(const_cast<uint32_t*>(words.data()));
}

}  // namespace

std::vector<Donor> giDonorsOf(const FrameSnapshot& kept, size_t pixel) {
  if (kept.frame == nullptr || kept.scene == nullptr) return {};
  rl::ReuseBuffers buffers{};
  bind(kept, "visible", buffers.visible);
  bind(kept, "visible_before", buffers.visibleBefore);
  bind(kept, "proposals", buffers.proposals);
  bind(kept, "shading_points", buffers.shadingPoints);
  bind(kept, "changes", buffers.changes);
  bind(kept, "reservoirs", buffers.reservoirs);
  bind(kept, "path_suffixes", buffers.suffixes);
  bind(kept, "spatial_shift", buffers.pairedShifts);
  bind(kept, "entry_reservoirs", buffers.entryReservoirs);
  bind(kept, "entry_suffixes", buffers.entrySuffixes);
  const rl::uvec2 at(pixel % kept.frame->width, pixel / kept.frame->width);
  // Scenes without glossy surfaces have no suffixes.
  constexpr uint32_t kAll = rl::RL_FEATURE_ALL;
  return buffers.suffixes.data != nullptr
             ? rl::donorsOf<kAll>(kept, buffers, giParamsOf(kept), at)
             : rl::donorsOf<kAll & ~rl::RL_FEATURE_GLOSSY>(kept, buffers, giParamsOf(kept), at);
}

}  // namespace restlab
