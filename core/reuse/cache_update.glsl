// cache_update, a pass of caches in world space: each entry that was seen merges samples that
// pixels have inserted in this frame. A candidate is the sample that the pixel found in this frame
// alone, at this frame's film sample. The entry's own sample is shifted to the candidate's x1, so
// that the merge is right for each film sample on its own. A new entry begins with a candidate, at
// the x1 that the candidate started from: the candidate is a valid sample there, and for no other
// point. An entry without insertions may forget (core/reuse/history_kept.glsl).
#include "core/caches/entries/surface.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/history_kept.glsl"

#define RL_REUSE_STATE CacheMerge

RL_FN bool reuseDonor(RL_IN(CacheMerge) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  if (s.donorId[k] == RL_INVALID) return false;
  donor = candidateStateRead(entryCandidatePixel(s.donorId[k]));
  return true;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(CacheMerge) s, uint k) {
  return s.canonicalAtNeighbour[k];
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(CacheMerge) s, uint k) {
  return s.neighbourAtCanonical[k];
}
RL_FN real3 reuseRatio(RL_IN(CacheMerge) s, uint k) {
  uint pixelIndex = entryCandidatePixel(s.donorId[k]);
  GBufferTexel donor = gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
  return reuseReflectanceRatio(
      donor.reflectance, shadingPointRead(gBuffers.shadingPoints, s.owner).surface.reflectance,
      gParams.reuse.maxReflectanceRatio);
}
RL_FN real reuseUniform(RL_IN(CacheMerge) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/merge_loop.glsl"

// Traces three rays per candidate: the camera ray to the candidate's x1, from that x1 to the
// entry's sample, and from the shading point to the candidate's sample. If the entry has no shading
// point, the first candidate that shows the pixel's surface provides it: `here` becomes that
// candidate, and the entry begins. Returns whether the entry has begun.
RL_FN bool shiftCandidates(RL_INOUT(CacheMerge) s, RL_INOUT(RL_RESERVOIR) here,
                           RL_INOUT(ShadingPoint) shadingPoint) {
  bool isNew = shadingPoint.surface.isHit == 0u;
  bool hasBegun = false;
  bool hasX1 = false;
  RL_RESERVOIR candidate = here;
  Surface x1 = shadingPointSurface(shadingPointNone());
  for (uint i = 0u; i < 3u * RL_ENTRY_INSERTIONS; i = i + 1u) {
    uint k = i / 3u;
    uint leg = i - 3u * k;
    uint group = s.donorId[k];
    if (group == RL_INVALID || hasBegun) continue;
    uint pixelIndex = entryCandidatePixel(group);
    RL_SHIFT shift = shiftNone();
    if (leg == 0u) {
      candidate = candidateRead(pixelIndex);
      shift.ray = cameraFilmRay(gFrame.camera, pixelOfIndex(pixelIndex), sampleFilm(candidate));
      shift.needs = RL_SHIFT_NEEDS_X1;
    } else if (leg == 1u) {
      if (!isNew && hasX1) shift = shiftToSurface(here, x1);
    } else if (shadingPoint.surface.isHit != 0u) {
      shift = shiftToSurface(candidate, shadingPointSurface(shadingPoint));
    }
    if (shift.needs != RL_SHIFT_DONE) {
      Hit hit = traceNoHit();
      uint mode = leg == 0u ? RL_RAY_PATH : RL_RAY_SHADOW;
      uint key = shiftRayKey(mode, sampleFilm(candidate));
      float transmittance = traceRay(shift.ray, mode, key, hit);
      if (leg != 0u) {
        shift.shifted.F *= transmittance;
      } else {
        hasX1 = false;
        if (hit.instance != RL_INVALID) {
          x1 = surfaceLoad(hit, shift.ray.dir);
          hasX1 = shiftIsReusable(x1.bsdf);
        }
        // An entry that is there already counts this donor's confidence all the same: confidence
        // must not depend on the sample.
        if (!hasX1 && isNew) s.donorId[k] = RL_INVALID;
        if (hasX1 && isNew) {
          GBufferTexel shown = gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
          ShadingPoint found = shadingPointOfSurface(x1, pixelIndex);
          if (gbufferIsSimilar(shown, found.surface, gParams.pairs.similarity))
            shadingPoint = found;
        }
      }
    }
    if (leg == 1u) s.canonicalAtNeighbour[k] = shift.shifted;
    if (leg == 2u) s.neighbourAtCanonical[k] = shift.shifted;
    if (leg == 2u && isNew && shadingPoint.surface.isHit != 0u) {
      hasBegun = true;
      here = candidate;
      here.state.F = shift.shifted.F;
      here.state.residual = vec3(0.0f, 0.0f, 0.0f);
      if (!(reuseTarget(here.state.F) > 0.0f)) here.state.W = 0.0f;
      sampleAfterShift(here, shift.shifted.jacobian);
    }
  }
  return hasBegun;
}

RL_FN void forgetOutOfView(uint entry) {
  float kept = historyKeptOutOfView(entry);
  if (kept == 1.0f) return;
  ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, entry);
  if (shadingPoint.surface.isHit == 0u) return;
  RL_RESERVOIR here = entryReservoirRead(entry);
  here.state.confidence *= kept;
  entryReservoirWrite(entry, here);
  if (!(kept > 0.0f)) shadingPointWrite(gBuffers.shadingPoints, entry, shadingPointNone());
}

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  if (entry >= gParams.entries.count) return;
  CacheMerge s;
  s.owner = entry;
  uint first = RL_INVALID;
  for (uint k = 0u; k < RL_ENTRY_INSERTIONS; k = k + 1u) {
    uint priority = gBuffers.insertions.data[entry * RL_ENTRY_INSERTIONS + k];
    s.donorId[k] = priority != 0u ? groupOfPriority(priority) : RL_INVALID;
    if (priority != 0u && first == RL_INVALID) first = k;
  }
  if (first == RL_INVALID) {
    forgetOutOfView(entry);
    return;
  }
  ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, entry);
  RL_RESERVOIR here = entryReservoirRead(entry);
  // Share kept, as found at the pixel of the first inserting group.
  float kept = historyKept(entryCandidatePixel(s.donorId[first]));
  here.state.confidence = reuseCapped(here.state.confidence, gParams.entries.cap) * kept;
  bool isForgotten = !(kept > 0.0f);
  if (isForgotten) shadingPoint = shadingPointNone();
  bool isNew = shadingPoint.surface.isHit == 0u;
  if (isNew) here.state = reservoirEmpty();
  bool hasBegun = shiftCandidates(s, here, shadingPoint);
  if (isNew) {
    if (!hasBegun && !isForgotten) return;
    shadingPointWrite(gBuffers.shadingPoints, entry, shadingPoint);
    reservoirGuard(here.state);
    entryReservoirWrite(entry, here);
    return;
  }
  s.rng = rngInit(gFrame.seed, entry, gFrame.frame);
  s.rng.vertex = RL_VERTEX_CACHE_UPDATE;
  uint winner;
  float jacobian;
  reuseMerge(s, RL_ENTRY_INSERTIONS, gParams.reuse.spatialFlags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner != RL_INVALID) {
    takeCandidateSample(entryCandidatePixel(s.donorId[winner]), here);
    sampleAfterShift(here, jacobian);
  }
  entryReservoirWrite(entry, here);
}
