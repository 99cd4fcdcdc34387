// restir_gi, spatial pass: merges neighbours' temporal reservoirs, shades, and leaves the history.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/caches/cache.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/bridge.glsl"
#include "integrators/restir_gi/merge.glsl"

RL_FN DonorSet giSpatialDonors(RL_IN(uvec2) pixel, RL_IN(Anchor) here, RL_IN(Rng) rng) {
  DonorSet donors;
  donors.count = 0u;
  float cameraDistance = distance(gFrame.camera.posW, here.posW);
  uint attempts = gParams.spatialNeighbours * gParams.spatialTries;
  for (uint i = 0u; i < attempts && donors.count < gParams.spatialNeighbours; i = i + 1u) {
    uint candidate;
    if (!cacheDonorOverSpace(pixel, rng, i, candidate)) continue;
    Anchor there = cacheAnchorNow(candidate);
    if (!cacheAnchorsMatch(here, there, cameraDistance)) continue;
    donors.slot[donors.count] = candidate;
    donors.count = donors.count + 1u;
  }
  return donors;
}

// Each returns what the pixel shows and leaves its reservoir in the history.
RL_FN vec3 giMergeLights(uint slot, RL_IN(Anchor) here, RL_INOUT(DonorSet) donors, RL_IN(Rng) rng) {
  ReservoirState state = gBuffers.lights.data[slot].state;
  bool isEmpty = giIsEmpty(state);
  for (uint k = 0u; k < donors.count; k = k + 1u) {
    ReservoirState theirs = gBuffers.lights.data[donors.slot[k]].state;
    donors.confidence[k] = theirs.confidence;
    state.confidence += theirs.confidence;
    isEmpty = isEmpty && giIsEmpty(theirs);
  }
  if (isEmpty) {
    gBuffers.lightsHistory.data[slot].state = state;
    return vec3(0.0f, 0.0f, 0.0f);
  }
  LightReservoir r;
  cacheReadNow(slot, r);
  real3 estimate;
  reuseMerge(r, here, donors, gParams.spatialFlags, rng, RL_DIM_RIS_MERGE_DI, estimate);
  cacheWriteHistory(slot, r);
  return estimate;
}

RL_FN vec3 giMergePaths(uint slot, RL_IN(Anchor) here, RL_INOUT(DonorSet) donors, RL_IN(Rng) rng) {
  ReservoirState state = gBuffers.paths.data[slot].state;
  bool isEmpty = giIsEmpty(state);
  for (uint k = 0u; k < donors.count; k = k + 1u) {
    ReservoirState theirs = gBuffers.paths.data[donors.slot[k]].state;
    donors.confidence[k] = theirs.confidence;
    state.confidence += theirs.confidence;
    isEmpty = isEmpty && giIsEmpty(theirs);
  }
  if (isEmpty) {
    gBuffers.pathsHistory.data[slot].state = state;
    return vec3(0.0f, 0.0f, 0.0f);
  }
  PathReservoir r;
  cacheReadNow(slot, r);
  real3 estimate;
  reuseMerge(r, here, donors, gParams.spatialFlags, rng, RL_DIM_RIS_MERGE_GI, estimate);
  cacheWriteHistory(slot, r);
  return estimate;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  vec3 radiance = gBuffers.ownLight.data[slot];
  Anchor here = cacheAnchorNow(slot);
  if (here.isReusable != 0u) {
    Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
    rng.vertex = RL_VERTEX_SPATIAL;
    DonorSet donors = giSpatialDonors(pixel, here, rng);
    if (giWantsDirect()) radiance += giMergeLights(slot, here, donors, rng);
    if (giWantsIndirect()) radiance += giMergePaths(slot, here, donors, rng);
  }
  if (!rlIsFinite3(radiance)) {
    // A poisoned history would spread: it starts again from nothing here.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    ReservoirState empty;
    empty.W = 0.0f;
    empty.F = vec3(0.0f, 0.0f, 0.0f);
    empty.residual = vec3(0.0f, 0.0f, 0.0f);
    empty.confidence = 1.0f;
    if (giWantsDirect()) gBuffers.lightsHistory.data[slot].state = empty;
    if (giWantsIndirect()) gBuffers.pathsHistory.data[slot].state = empty;
  }
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[slot] = radiance;
}
