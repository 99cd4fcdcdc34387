// restir_gi, temporal pass: merges the last frame's reservoir of the same surface into the new one,
// then shows the result to the pixel's partners of the spatial pass, each shift once for both
// merges of a pair. In a still view the shift over time is the identity: no ray. Round 0 is that of
// time, each further one that of a partner. A round's shifts take two rays each, the camera's to
// the x1 of the other pixel and the segment from there; all are traced by the one call of the
// kernel.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/payload/path_sample.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/reuse.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/donors.glsl"

// A shift to a pixel of this frame's camera or of the last one's.
RL_FN void giAskShift(RL_INOUT(GiShift) shift, RL_IN(PathReservoir) r, RL_IN(uvec2) pixel,
                      bool isBefore, bool assumeVisible) {
  shift.shifted.F = vec3(0.0f, 0.0f, 0.0f);
  shift.shifted.jacobian = 1.0f;
  shift.isBefore = isBefore ? 1u : 0u;
  if (isBefore) {
    shift.ray = cameraFilmRay(gFrame.previousCamera, pixel, r.path.film);
  } else {
    shift.ray = cameraFilmRay(gFrame.camera, pixel, r.path.film);
  }
  shift.asks = r.state.W > 0.0f ? RL_GI_ASKS_X1 : 0u;
  shift.assumesVisible = assumeVisible ? 1u : 0u;
}

// The ray through the film sample has met x1.
RL_FN void giReconnect(RL_INOUT(GiShift) shift, RL_IN(PathReservoir) r, RL_IN(Hit) hit) {
  shift.asks = 0u;
  if (hit.instance == RL_INVALID) return;
  Surface x1 = surfaceLoad(hit, shift.ray.dir);
  if (!bsdfIsReusable(x1.bsdf, gParams.minAlpha)) return;
  if (shift.isBefore != 0u) {
    x1.wo = cameraDirectionFrom(gFrame.previousCamera, x1.posW);
  } else {
    x1.wo = cameraDirectionFrom(gFrame.camera, x1.posW);
  }
  shift.shifted = pathShift(r.path, x1, gParams.maxJacobian);
  if (!reuseAsksVisibility(shift.shifted, shift.assumesVisible != 0u)) return;
  shift.ray = pathSegment(r.path, x1);
  shift.asks = RL_GI_ASKS_SEGMENT;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  uint flags = gParams.temporalFlags;
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(slot, r);  // kept from round to round: what this pass has written it may not read
  uint rounds = giDonors(slot);
  for (uint round = 0u; round <= gParams.spatialNeighbours; round = round + 1u) {
    uint other = RL_INVALID;  // the slot that is exchanged with
    bool merges = false;
    PathReservoir donor = r;
    GiShift ours;    // this pixel's sample as the other sees it
    GiShift theirs;  // the other's sample as this pixel sees it
    giAskShift(ours, r, pixel, false, false);
    ours.asks = 0u;
    theirs = ours;
    if (round == 0u) {
      merges = gParams.temporalReuse != 0u && cacheDonorOverTime(slot, other);
      if (merges) giReadBefore(other, donor);
      if (merges && reuseIsEmpty(r.state) && reuseIsEmpty(donor.state)) {
        r.state.confidence += reuseCapped(donor.state.confidence, gParams.confidenceCap);
        giWriteStateNow(slot, r.state);
        merges = false;
      }
      if (merges && gFrame.isStillView != 0u) {
        ours.shifted = mergeUnshifted(r.state);
        theirs.shifted = mergeUnshifted(donor.state);
      } else if (merges) {
        giAskShift(ours, r, cachePixel(other), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
        giAskShift(theirs, donor, pixel, false, (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u);
      }
    } else {
      merges = cachePartner(pixel, round - 1u, other);
      if (merges) merges = round <= max(rounds, giDonors(other));
      if (merges) giAskShift(ours, r, cachePixel(other), false, false);
    }
    // Two rays of each shift, one after the other. The mode is what each pixel asks for, not what
    // the loop counts: Mesa 22.3 crashes on a mode that all pixels share (docs/dialect.md).
    for (uint i = 0u; i < 4u; i = i + 1u) {
      bool isOurs = (i & 1u) == 0u;
      uint asks = isOurs ? ours.asks : theirs.asks;
      if (asks == 0u) continue;
      Ray ray = theirs.ray;
      uint film = donor.path.film;
      if (isOurs) {
        ray = ours.ray;
        film = r.path.film;
      }
      Hit hit;
      hit.instance = RL_INVALID;
      hit.primitive = RL_INVALID;
      hit.bary = vec2(0.0f, 0.0f);
      hit.t = 0.0f;
      uint mode = asks == RL_GI_ASKS_X1 ? RL_RAY_PATH : RL_RAY_SHADOW;
      float transmittance = traceRay(ray, mode, cameraAlphaKey(film), hit);
      if (asks == RL_GI_ASKS_SEGMENT) {
        if (isOurs) ours.shifted.F *= transmittance;
        if (!isOurs) theirs.shifted.F *= transmittance;
      } else if (isOurs) {
        giReconnect(ours, r, hit);
      } else {
        giReconnect(theirs, donor, hit);
      }
    }
    if (round > 0u) {
      uint index = giExchangeIndex(slot, round - 1u);
      if (merges) giWriteShifted(index, ours.shifted);
      gBuffers.partners.data[index] = merges ? other : RL_INVALID;
      continue;
    }
    if (!merges) continue;
    real cDonor = reuseCapped(donor.state.confidence, gParams.confidenceCap);
    // Where both are samples of one pixel their targets are one: weights by confidence are exact.
    if (gFrame.isStillView != 0u) flags = flags & ~RL_REUSE_PAIRWISE;
    MergeState merge = mergeBegin(r.state, cDonor);
    mergeWeighCanonical(merge, r.state, cDonor, ours.shifted, flags);
    mergeCanonical(merge, r.state, flags);
    vec3 ratio = vec3(1.0f, 1.0f, 1.0f);
    if (gFrame.isStillView == 0u) ratio = giRatio(visibleRead(gBuffers.visibleBefore, other), slot);
    float u = rngDraw(rng, RL_DIM_RIS_MERGE);
    bool won = mergeDonor(merge, r.state, donor.state, cDonor, theirs.shifted, ratio, flags, u);
    mergeEnd(merge, r.state, flags);
    if (won) {
      r.path = donor.path;
      r.path.geometry *= theirs.shifted.jacobian;
      giWriteNow(slot, r);
    } else {
      giWriteStateNow(slot, r.state);
    }
  }
}
