// cache_reuse, a pass of caches in world space, in frames of a new view: merges samples of
// entries into the pixel's reservoir. An entry's sample is a path from its shading point alone;
// here it gets a film sample, drawn for this one merge. Both samples then have one domain, film
// times paths, and the shift between them keeps the film sample. The shading point depends on the
// film sample of the pixel that began the entry. If that pixel used the entry, its MIS weights
// would depend on its own film sample; so it does not. (The film sample may travel by reuse:
// docs/decisions/reservoirs-of-entries.md.)
#include "core/caches/entries/surface.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/reflectance_ratio.glsl"
#include "core/reuse/history_weight.glsl"

#define RL_REUSE_STATE CacheMerge

RL_FN bool reuseDonor(RL_IN(CacheMerge) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  uint entry = s.id[k];
  if (entry == RL_INVALID) return false;
  donor = entryStateRead(entry);
  donor.confidence = reuseCapped(donor.confidence, gParams.reuse.movingConfidenceCap) *
                     historyWeight(s.pixelIndex);
  return true;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(CacheMerge) s, uint k) {
  return s.canonicalAtNeighbour[k];
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(CacheMerge) s, uint k) {
  return s.neighbourAtCanonical[k];
}
RL_FN real3 reuseRatio(RL_IN(CacheMerge) s, uint k) {
  return pixelReflectanceRatio(shadingPointRead(gBuffers.shadingPoints, s.id[k]).surface,
                               s.pixelIndex);
}
RL_FN real reuseUniform(RL_IN(CacheMerge) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/reuse.glsl"

// Traces one camera ray, then two segments per entry: from the shading point to the pixel's sample,
// and from the film sample's x1 to the entry's sample. The biased mode traces both, too: taken as
// free, the first costs up to a fifth of the energy if shading points and pixel see different
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
    uint entry = s.id[k];
    RL_SHIFT shift = shiftNone();
    if (isCamera) {
      shift.ray = cameraFilmRay(gFrame.camera, pixel, film);
      shift.asks = RL_SHIFT_ASKS_X1;
    } else if (entry != RL_INVALID) {
      if (isOurs) {
        shift = shiftToSurface(
            here, shadingPointSurface(shadingPointRead(gBuffers.shadingPoints, entry)));
      } else if (hasX1) {
        entryReservoirRead(entry, other);
        shift = shiftToSurface(other, x1);
      }
    }
    if (shift.asks != RL_SHIFT_DONE) {
      Hit hit = traceNoHit();
      uint mode = isCamera ? RL_RAY_PATH : RL_RAY_SHADOW;
      uint key = shiftKey(mode, film);
      float transmittance = traceRay(shift.ray, mode, key, hit);
      if (!isCamera) {
        shift.shifted.F *= transmittance;
      } else if (hit.instance != RL_INVALID) {
        x1 = surfaceLoad(hit, shift.ray.dir);
        hasX1 = shiftServes(x1.bsdf);
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

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  CacheMerge s;
  s.pixelIndex = pixelIndexOf(pixel);
  uint count = gParams.entries.proposals;
  bool isAsked = false;
  for (uint k = 0u; k < count; k = k + 1u) {
    s.id[k] = gBuffers.proposals.data[s.pixelIndex * count + k];
    if (s.id[k] == RL_INVALID) continue;
    ShadingPoint shadingPoint = shadingPointRead(gBuffers.shadingPoints, s.id[k]);
    if (shadingPoint.surface.isHit == 0u || shadingPoint.sourcePixel == s.pixelIndex)
      s.id[k] = RL_INVALID;
    if (s.id[k] != RL_INVALID) isAsked = true;
  }
  if (gParams.reuse.temporalReuse == 0u || !isAsked || !(historyWeight(s.pixelIndex) > 0.0f))
    return;
  RL_RESERVOIR here = sampleNone();
  reservoirReadNow(s.pixelIndex, here);
  s.rng = rngInit(gFrame.seed, s.pixelIndex, gFrame.frame);
  s.rng.vertex = RL_VERTEX_CACHE_REUSE;
  uint film = rngBits(s.rng, RL_DIM_FILTER_X);
  shiftEntries(s, here, pixel, film, count);
  uint winner;
  float jacobian;
  reuseMerge(s, count, gParams.reuse.spatialFlags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner == RL_INVALID) {
    stateWriteNow(s.pixelIndex, here);
  } else {
    takeEntrySample(s.id[winner], here);
    sampleSetFilm(here, film);
    sampleFollow(here, jacobian);
    reservoirWriteNow(s.pixelIndex, here);
  }
}
