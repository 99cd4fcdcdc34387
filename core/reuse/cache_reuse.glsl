// cache_reuse, a pass of caches in world space, in frames of a new view: merges samples of
// entries into the pixel's reservoir. An entry's sample is a path from its shading point alone;
// here it gets a film sample, drawn for this one merge. Both samples then have one domain, film
// times paths, and the shift between them keeps the film sample. The shading point depends on the
// film sample of the pixel that began the entry. That pixel must not use the entry: the domain
// of this donor would depend on the pixel's own film sample, and the merge would be biased. (The
// film sample may travel by reuse: docs/decisions/reservoirs-of-entries.md.)
#include "core/caches/entries/surface.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/reflectance_ratio.glsl"
#include "core/reuse/history_kept.glsl"

#define RL_REUSE_STATE CacheMerge

RL_FN bool reuseDonor(RL_IN(CacheMerge) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  uint entry = s.donorId[k];
  if (entry == RL_INVALID) return false;
  donor = entryStateRead(entry);
  donor.confidence =
      reuseCapped(donor.confidence, gParams.reuse.movingConfidenceCap) * historyKept(s.owner);
  return true;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(CacheMerge) s, uint k) {
  return s.canonicalAtNeighbour[k];
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(CacheMerge) s, uint k) {
  return s.neighbourAtCanonical[k];
}
RL_FN real3 reuseRatio(RL_IN(CacheMerge) s, uint k) {
  return pixelReflectanceRatio(shadingPointRead(gBuffers.shadingPoints, s.donorId[k]).surface,
                               s.owner);
}
RL_FN real reuseUniform(RL_IN(CacheMerge) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/merge_loop.glsl"

// Traces one camera ray, then two segments per entry: from the shading point to the pixel's sample,
// and from the film sample's x1 to the entry's sample. The biased mode traces both, too: taken as
// unoccluded, the first costs up to a fifth of the energy if shading points and pixel see different
// things.
RL_FN void shiftEntries(RL_INOUT(CacheMerge) s, RL_IN(RL_RESERVOIR) here, RL_IN(uvec2) pixel,
                        uint film, uint count) {
  Surface x1 = shadingPointSurface(shadingPointNone());
  bool hasX1 = false;
  RL_RESERVOIR other = here;
  for (uint i = 0u; i < 1u + 2u * count; i = i + 1u) {
    bool isCamera = i == 0u;
    bool isOurs = (i & 1u) != 0u;
    uint k = isCamera ? 0u : (i - 1u) / 2u;
    uint entry = s.donorId[k];
    RL_SHIFT shift = shiftNone();
    if (isCamera) {
      shift.ray = cameraFilmRay(gFrame.camera, pixel, film);
      shift.needs = RL_SHIFT_NEEDS_X1;
    } else if (entry != RL_INVALID) {
      if (isOurs) {
        shift = shiftToSurface(
            here, shadingPointSurface(shadingPointRead(gBuffers.shadingPoints, entry)));
      } else if (hasX1) {
        other = entryReservoirRead(entry);
        shift = shiftToSurface(other, x1);
      }
    }
    if (shift.needs != RL_SHIFT_DONE) {
      Hit hit = traceNoHit();
      uint mode = isCamera ? RL_RAY_PATH : RL_RAY_SHADOW;
      uint key = shiftRayKey(mode, film);
      float transmittance = traceRay(shift.ray, mode, key, hit);
      if (!isCamera) {
        shift.shifted.F *= transmittance;
      } else if (hit.instance != RL_INVALID) {
        x1 = surfaceLoad(hit, shift.ray.dir);
        hasX1 = shiftIsReusable(x1.bsdf);
      }
    }
    if (isCamera) continue;
    if (isOurs) {
      s.canonicalAtNeighbour[k] = shift.shifted;
    } else {
      s.neighbourAtCanonical[k] = shift.shifted;
    }
  }
}

// Takes the entries that the pixel has as donors. Returns whether there is one.
RL_FN bool findEntries(RL_INOUT(CacheMerge) s, uint pixelIndex, uint count) {
  s.owner = pixelIndex;
  bool hasEntries = false;
  for (uint k = 0u; k < count; k = k + 1u) {
    s.donorId[k] = gBuffers.proposals.data[pixelIndex * count + k];
    if (s.donorId[k] == RL_INVALID) continue;
    ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, s.donorId[k]);
    if (shadingPoint.surface.isHit == 0u || shadingPoint.sourcePixel == pixelIndex)
      s.donorId[k] = RL_INVALID;
    if (s.donorId[k] != RL_INVALID) hasEntries = true;
  }
  return gParams.reuse.temporalReuse != 0u && hasEntries && historyKept(pixelIndex) > 0.0f;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  CacheMerge s;
  uint count = gParams.entries.proposals;
  if (!findEntries(s, pixelIndexOf(pixel), count)) return;
  RL_RESERVOIR here = reservoirReadNow(s.owner);
  s.rng = rngInit(gFrame.seed, s.owner, gFrame.frame);
  s.rng.vertex = RL_VERTEX_CACHE_REUSE;
  uint film = rngBits(s.rng, RL_DIM_FILTER_X);
  shiftEntries(s, here, pixel, film, count);
  uint winner;
  float jacobian;
  reuseMerge(s, count, gParams.reuse.spatialFlags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner == RL_INVALID) {
    stateWriteNow(s.owner, here);
  } else {
    takeEntrySample(s.donorId[winner], here);
    sampleSetFilm(here, film);
    sampleAfterShift(here, jacobian);
    reservoirWriteNow(s.owner, here);
  }
}
