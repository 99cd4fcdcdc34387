// restir_gi, temporal pass: merges the last frame's reservoir of the same surface into the new one.
#define RL_DONORS_BEFORE
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/caches/cache.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/bridge.glsl"
#include "integrators/restir_gi/merge.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  if (gParams.temporalReuse == 0u) return;
  Anchor here = cacheAnchorNow(slot);
  if (here.isReusable == 0u) return;
  uint donorSlot;
  if (!cacheDonorOverTime(here, donorSlot)) return;
  Anchor there = cacheAnchorBefore(donorSlot);
  if (!cacheAnchorsMatch(here, there, distance(gFrame.camera.posW, here.posW))) return;
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  DonorSet donors;
  donors.count = 1u;
  donors.slot[0] = donorSlot;
  real3 estimate;
  if (giWantsDirect()) {
    ReservoirState mine = gBuffers.lights.data[slot].state;
    ReservoirState theirs = gBuffers.lightsHistory.data[donorSlot].state;
    donors.confidence[0] = giCappedConfidence(theirs.confidence);
    if (giIsEmpty(mine) && giIsEmpty(theirs)) {
      gBuffers.lights.data[slot].state.confidence = mine.confidence + donors.confidence[0];
    } else {
      LightReservoir r;
      cacheReadNow(slot, r);
      reuseMerge(r, here, donors, gParams.temporalFlags, rng, RL_DIM_RIS_MERGE_DI, estimate);
      cacheWriteNow(slot, r);
    }
  }
  if (giWantsIndirect()) {
    ReservoirState mine = gBuffers.paths.data[slot].state;
    ReservoirState theirs = gBuffers.pathsHistory.data[donorSlot].state;
    donors.confidence[0] = giCappedConfidence(theirs.confidence);
    if (giIsEmpty(mine) && giIsEmpty(theirs)) {
      gBuffers.paths.data[slot].state.confidence = mine.confidence + donors.confidence[0];
    } else {
      PathReservoir r;
      cacheReadNow(slot, r);
      reuseMerge(r, here, donors, gParams.temporalFlags, rng, RL_DIM_RIS_MERGE_GI, estimate);
      cacheWriteNow(slot, r);
    }
  }
}
