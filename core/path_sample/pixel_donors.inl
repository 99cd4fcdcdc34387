// The probe of a pixel, for methods that resample paths: its reservoir, and the merges of
// the last frame, computed again on the host. Included by a source that rl_add_path_probe makes
// for each method, and which defines RL_METHOD_INITIAL, RL_METHOD_SPATIAL, RL_METHOD_SPATIAL_SHIFT
// and RL_METHOD_CACHE_REUSE, the method's kernels, and RL_METHOD_SETS_PROBE, the function that is
// declared in its <name>.cpp.
//
// Donors are the canonical sample, then those over space and time, then entries. The frame has
// overwritten the reservoir of the donor over time: the initial candidate is traced again, and what
// its resampling weight leaves of wSum is the donor's.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "core/backend/trace_callbacks.h"
#include "core/backend/cpu_kernel.h"
#include "core/backend/embree.h"
#include "core/frame/integrator.h"
#include "core/path_sample/path_names.h"
#include "core/reuse/passes.h"
#include "core/scene/compiled/compiled_scene.h"

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

using Vertices = std::vector<restlab::PathVertex>;

// Shifts of the method.
#define RL_REPLAY_WATCH_VERTEX(posW) addVertex(posW, false);
#define RL_REPLAY_WATCH_LIGHT(isEnd, posW) \
  if (isEnd) addLight(posW, false);
#define RL_REPLAY_WATCH_MISS(dirW) addDirection(dirW, false);
namespace of_shifts {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include RL_METHOD_SPATIAL_SHIFT

  Vertices watched_ = {};

  void addVertex(vec3 posW, bool isReconnected) {
    restlab::PathVertex& v = watched_.emplace_back();
    v.name = fmt::format("x{}", watched_.size());
    v.posW = posW;
    v.isReconnected = isReconnected;
    vec2 film;
    if (cameraProject(gFrame.camera, posW, vec2(gFrame.width, gFrame.height), film)) v.film = film;
  }
  void addLight(vec3 posW, bool isReconnected) {
    addVertex(posW, isReconnected);
    watched_.back().name = "light";
  }
  void addDirection(vec3 dirW, bool isReconnected) {
    // On a perspective film, lines of this direction vanish at one point.
    const bool vanishes = gFrame.camera.kind != RL_CAMERA_ORTHOGRAPHIC || watched_.empty();
    addVertex((vanishes ? gFrame.camera.posW : watched_.back().posW) + dirW, isReconnected);
    watched_.back().name = "environment";
    watched_.back().posW = dirW;
    watched_.back().isDirection = true;
  }
  // Traces the part of a path that a shift traces again.
  void addTraced(const PathSample& path, const Ray& ray) {
#ifdef RL_PATH_REPLAYS
    pathReplay(path, ray);
#else
    Hit hit = traceNoHit();
    traceRay(ray, RL_RAY_PATH, cameraAlphaKey(path.film), hit);
    if (hit.instance != RL_INVALID) addVertex(surfaceLoad(hit, ray.dir).posW, false);
#endif
  }
  Vertices verticesOf(const PathSample& path, uvec2 pixel) {
    watched_.clear();
    addTraced(path, cameraFilmRay(gFrame.camera, pixel, path.film));
    if (isWholeReplay(path)) return watched_;
    const LightSample end = pathEnd(path);
    if (end.kind == RL_LIGHT_ENVIRONMENT || end.kind == RL_LIGHT_DIRECTIONAL) {
      addDirection(end.point, true);
      if (end.kind == RL_LIGHT_DIRECTIONAL) watched_.back().name = "light";
    } else if (pathEndsAtLight(path)) {
      addLight(end.point, true);
    } else {
      addVertex(end.point, true);
    }
    return watched_;
  }
  bool isWholeReplay(const PathSample& path) {
#ifdef RL_PATH_REPLAYS
    return pathKind(path) == RL_PATH_WHOLE_REPLAY;
#else
    return false;
#endif
  }

  PathShift shifted(const PathReservoir& r, uvec2 pixel, bool isPrevious, bool assumesVisible) {
    PathShift shift = shiftTo(r, pixel, isPrevious, assumesVisible);
    shiftTrace(shift, r);
    return shift;
  }
  // Why the shift of a sample to a pixel of this frame has no share.
  const char* failure(const PathReservoir& r, uvec2 pixel) {
    return restlab::nameOfFailedShift(shifted(r, pixel, false, false).failed);
  }
};
}  // namespace of_shifts
#undef RL_REPLAY_WATCH_VERTEX
#undef RL_REPLAY_WATCH_LIGHT
#undef RL_REPLAY_WATCH_MISS

#undef RL_WALK_STATE

// The spatial pass, watched; as in core/backend/cpu_kernel.inl.
#define RL_REUSE_WATCH_CANONICAL(merge, canonical) watchCanonical(merge, canonical);
#define RL_REUSE_WATCH_DONOR(k, donor, shifted, merge, isSelected) \
  watchDonor(state.pixelIndex, k, donor, shifted, merge, isSelected);
namespace over_space {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include RL_METHOD_SPATIAL
#include "core/path_sample/merge_donors.inl"

  of_shifts::Ctx* shifts_ = nullptr;
  Donors watched_ = {};
  size_t watchedWinner_ = 0;
  real watchedWSum_ = 0.0f;

  void watchCanonical(const MergeState& merge, const ReservoirState& own) {
    restlab::Donor& canonical = watched_.emplace_back();
    canonical.reuse = "canonical";
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
    if (!watched_.back().jacobian)
      watched_.back().shift =
          shifts_->failure(reservoirReadNow(neighbour), pixelOfIndex(pixelIndex));
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
#undef RL_WALK_STATE

// The initial pass, which finds the pixel's sample of this frame again, and the temporal merge.
namespace over_time {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include RL_METHOD_INITIAL
#include "core/gbuffer/gbuffer_trace.glsl"

  // Traces the surface again: later passes have used the memory of the last frame's.
  GBufferTexel gbufferPrevious(uint pixelIndex) {
    float distanceToCamera;
    return gbufferTrace(gFrame.previousCamera, pixelIndex, distanceToCamera);
  }

#include "core/resampling/reproject.glsl"

  of_shifts::Ctx* shifts_ = nullptr;

  PathReservoir retraceInitialCandidate(uvec2 pixel) {
    vec3 specularLight, lightInView;
    PathReservoir r = sampleInitial(pixel, cameraFilmBits(pixel), specularLight, lightInView);
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
      mergeWeighCanonical(
          merge, own.state, cDonor,
          shifts_->shifted(own, pixelOfIndex(previousPixel), true, assumesVisible).shifted, flags);
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
#undef RL_WALK_STATE
#undef RL_WALK_END

// The cache_reuse pass.
namespace of_entries {
struct Ctx {
#include "core/path_sample/pixel_context.inl"
#include RL_METHOD_CACHE_REUSE
#include "core/path_sample/merge_donors.inl"

  // Names the first test that the shift of an entry's sample to the pixel fails, with x1 seen
  // through `film`.
  const char* failure(const PathReservoir& r, uvec2 pixel, uint film) {
    if (!(r.state.W > 0.0f)) return "empty";
    const Ray ray = cameraFilmRay(gFrame.camera, pixel, film);
    Hit hit = traceNoHit();
    traceRay(ray, RL_RAY_PATH, cameraAlphaKey(film), hit);
    if (hit.instance == RL_INVALID) return "background";
    const Surface x1 = surfaceLoad(hit, ray.dir);
    if (!bsdfIsReusable(x1.bsdf, gParams.path.minAlpha)) return "smooth";
    PathShift shift = shiftToSurface(r, x1);
    shiftTrace(shift, r);
    return restlab::nameOfFailedShift(shift.failed);
  }

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
      if (!one.jacobian) one.shift = failure(entryReservoirRead(s.donorId[k]), pixel, film);
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

// Binds a buffer. Kernels only read it, so a copy that nobody writes to may be bound.
template <typename Ref>
void bindCopy(const restlab::FrameSnapshot& snapshot, const std::string& name, Ref& ref) {
  const std::span<const uint32_t> words = snapshot.words(name);
  ref.data = words.empty()
                 ? nullptr
                 : reinterpret_cast<decltype(ref.data)>(const_cast<uint32_t*>(words.data()));
}

// A frame as its kernels had it.
struct Frame {
  explicit Frame(const restlab::FrameSnapshot& snapshot)
      : scene(snapshot.scene->data()),
        frame(*snapshot.frame),
        rays(static_cast<RTCScene>(snapshot.scene->embreeScene())) {
    if (snapshot.params.size() == sizeof params)
      std::memcpy(&params, snapshot.params.data(), sizeof params);
  }

  SceneData scene;
  const FrameData& frame;
  RTCScene rays;
  ReuseBuffers buffers{};
  PathReuseParams params{};
  CpuKernelCounters counters;
};

Donors donorsOf(const restlab::FrameSnapshot& snapshot, size_t pixelIndex) {
  if (snapshot.frame == nullptr || snapshot.scene == nullptr) return {};
  Frame f(snapshot);
  bindCopy(snapshot, "gbuffer", f.buffers.gbuffer);
  bindCopy(snapshot, "proposals", f.buffers.proposals);
  bindCopy(snapshot, "shading_points", f.buffers.shadingPoints);
  bindCopy(snapshot, "changes", f.buffers.changes);
  bindCopy(snapshot, "reservoirs", f.buffers.reservoirs);
  bindCopy(snapshot, restlab::pairedShiftsName(0), f.buffers.pairedShifts0);
  bindCopy(snapshot, restlab::pairedShiftsName(1), f.buffers.pairedShifts1);
  bindCopy(snapshot, restlab::pairedShiftsName(2), f.buffers.pairedShifts2);
  bindCopy(snapshot, restlab::pairedShiftsName(3), f.buffers.pairedShifts3);
  bindCopy(snapshot, "entry_reservoirs", f.buffers.entryReservoirs);
  const uvec2 pixel(pixelIndex % f.frame.width, pixelIndex / f.frame.width);
  of_shifts::Ctx shifts{f.scene, f.frame, f.counters, f.rays, f.buffers, f.params};
  // The last round over space: its reservoirs, its number.
  ReuseBuffers ofLastRound = f.buffers;
  PathReuseParams inLastRound = f.params;
  inLastRound.reuse.spatialRound = f.params.reuse.spatialRounds - 1u;
  bindCopy(snapshot, restlab::lastRoundsReservoirs(f.params.reuse.spatialRounds),
           ofLastRound.reservoirs);
  over_space::Ctx space{f.scene, f.frame, f.counters, f.rays, ofLastRound, inLastRound};
  over_time::Ctx time{f.scene, f.frame, f.counters, f.rays, f.buffers, f.params};
  of_entries::Ctx entries{f.scene, f.frame, f.counters, f.rays, f.buffers, f.params};
  space.shifts_ = &shifts;
  time.shifts_ = &shifts;
  Donors all = space.overSpace(pixel), ofEntries;
  if (f.params.entries.count != 0u) ofEntries = entries.ofEntries(pixel);
  double confidence = time.reservoirReadNow(uint(pixelIndex)).state.confidence;
  for (const restlab::Donor& one : ofEntries) confidence -= one.confidence;
  for (const restlab::Donor& one : time.donors(pixel, float(confidence), ofEntries.empty()))
    all.push_back(one);
  all.insert(all.end(), ofEntries.begin(), ofEntries.end());
  return all;
}

std::string three(const vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

// Describes x2 or the light.
std::string endOf(of_shifts::Ctx& c, const PathSample& path) {
  const uint light = c.pathLightKind(path);
  const bool isLight = c.pathEndsAtLight(path);
  if (isLight && light == RL_LIGHT_ENVIRONMENT) return "direction " + three(path.wi);
  if (isLight && light != RL_LIGHT_AREA) return fmt::format("light {}", path.id.instance);
#ifdef RL_DIRECT_ONLY
  const std::string triangle = fmt::format("light {}", path.id.instance);
#else
  const std::string triangle =
      fmt::format("instance {}, triangle {}", path.id.instance, path.id.primitive);
#endif
  return fmt::format("{}, at {:.6g} {:.6g}", triangle, path.id.bary.x, path.id.bary.y);
}

// Values of the pixel's reservoir after the frame.
std::vector<restlab::ProbeValue> probe(const restlab::FrameSnapshot& snapshot, size_t pixel) {
  if (snapshot.frame == nullptr || snapshot.scene == nullptr) return {};
  Frame f(snapshot);
  bindCopy(snapshot, "reservoir_history", f.buffers.history);
  Uvec4Ref unresampled;
  bindCopy(snapshot, "unresampled_radiance", unresampled);
  of_shifts::Ctx c{f.scene, f.frame, f.counters, f.rays, f.buffers, f.params};
  const PathReservoir r = c.reservoirReadPrevious(uint(pixel));
  std::vector<restlab::ProbeValue> values = {
      {"unresampled light", three(c.recordVec3(unresampled.data[pixel]))},
      {"W", fmt::format("{:.6g}", r.state.W)},
      {"F", three(r.state.F)},
      {"residual", three(r.state.residual)}};
  if (!(r.state.W > 0.0f)) return values;
  values.push_back({"film", fmt::format("{:.4f} {:.4f}", double(r.path.film & 0xffffu) / 65536.0,
                                        double(r.path.film >> 16) / 65536.0)});
#ifdef RL_PATH_REPLAYS
  values.push_back({"k", fmt::format("{}", r.path.base + 2u)});
#endif
  if (c.isWholeReplay(r.path)) return values;
  values.push_back({"end", endOf(c, r.path)});
#ifndef RL_DIRECT_ONLY
  values.push_back({"radiance", three(r.path.radiance)});
#endif
  return values;
}

Vertices pathOf(const restlab::FrameSnapshot& snapshot, size_t pixelIndex) {
  if (snapshot.frame == nullptr || snapshot.scene == nullptr) return {};
  Frame f(snapshot);
  bindCopy(snapshot, "reservoir_history", f.buffers.history);
  of_shifts::Ctx c{f.scene, f.frame, f.counters, f.rays, f.buffers, f.params};
  const PathReservoir r = c.reservoirReadPrevious(uint(pixelIndex));
  if (!(r.state.W > 0.0f)) return {};
  return c.verticesOf(r.path, c.pixelOfIndex(uint(pixelIndex)));
}

// Number of a layer at a pixel.
using NumberAt = float (*)(of_shifts::Ctx&, uint pixelIndex);

restlab::LayerInfo layerOf(const char* name, const char* summary, NumberAt numberAt) {
  restlab::LayerInfo layer;
  layer.name = name;
  layer.summary = summary;
  layer.values =
      [numberAt](const restlab::FrameSnapshot& snapshot) -> std::function<float(size_t pixel)> {
    if (snapshot.frame == nullptr || snapshot.scene == nullptr) return [](size_t) { return 0.0f; };
    const auto f = std::make_shared<Frame>(snapshot);
    bindCopy(snapshot, "reservoir_history", f->buffers.history);
    bindCopy(snapshot, restlab::lastRoundsReservoirs(f->params.reuse.spatialRounds),
             f->buffers.reservoirs);
    bindCopy(snapshot, restlab::pairedShiftsName(0), f->buffers.pairedShifts0);
    return [f, numberAt](size_t pixel) {
      CpuKernelCounters counters;
      of_shifts::Ctx c{f->scene, f->frame, counters, f->rays, f->buffers, f->params};
      return numberAt(c, uint(pixel));
    };
  };
  return layer;
}

float kindAt(of_shifts::Ctx& c, uint pixelIndex) {
  const PathReservoir r = c.reservoirReadPrevious(pixelIndex);
  return r.state.W > 0.0f ? 1.0f + float(c.pathKind(r.path)) : 0.0f;
}

float replayedAt(of_shifts::Ctx& c, uint pixelIndex) {
  const PathReservoir r = c.reservoirReadPrevious(pixelIndex);
  return r.state.W > 0.0f ? float(r.path.base) : 0.0f;
}

float outcomeAt(of_shifts::Ctx& c, uint pixelIndex) {
  if (c.gBuffers.pairedShifts0.data == nullptr || c.gBuffers.reservoirs.data == nullptr ||
      c.spatialDonors() == 0u)
    return 0.0f;
  uint neighbour;
  c.shiftedRead(c.gBuffers.pairedShifts0, pixelIndex, neighbour);
  if (neighbour == RL_INVALID) return 0.0f;
  const PathReservoir r = c.reservoirReadNow(neighbour);
  return 1.0f + float(c.shifted(r, c.pixelOfIndex(pixelIndex), false, false).failed);
}

void addLayers(std::vector<restlab::LayerInfo>& layers) {
  restlab::LayerInfo kind =
      layerOf("kind",
              "kind of the pixel's sample: 1 + 0 direct light, 1 Lambert vertex, 2 to 4 glossy "
              "vertex (light sample, emitter, continued), 5 light of a smooth vertex, 6 replayed "
              "as a whole",
              kindAt);
  kind.isName = true;
  kind.wordsOf = [](float number) -> std::string {
    if (number < 1.0f) return "none: the reservoir is empty";
    return restlab::nameOfPathKind(uint32_t(number) - 1u);
  };
  restlab::LayerInfo outcome = layerOf(
      "shift_outcome",
      "outcome of the shift of the last round's first donor to the pixel: 1 accepted, more: "
      "the test that it failed",
      outcomeAt);
  outcome.isName = true;
  outcome.enabledIf.parameter = "spatial_neighbours";
  outcome.wordsOf = [](float number) -> std::string {
    return number < 1.0f ? "no donor" : restlab::nameOfFailedShift(uint32_t(number) - 1u);
  };
  layers.push_back(std::move(kind));
  layers.push_back(std::move(outcome));
#ifdef RL_PATH_REPLAYS
  layers.push_back(layerOf("replayed",
                           "scattering events of the pixel's sample that a shift replays: it "
                           "reconnects at x_k with k = 2 + this",
                           replayedAt));
#endif
}

}  // namespace

}  // namespace rl

namespace restlab {

void RL_METHOD_SETS_PROBE(IntegratorInfo& info) {
  info.probe = rl::probe;
  info.donors = rl::donorsOf;
  info.path = rl::pathOf;
  rl::addLayers(info.layers);
}

}  // namespace restlab
