// restir_gi, spatial pass: merges neighbours' temporal reservoirs, shades, and leaves the history.
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
  vec3 radiance = gBuffers.ownLight.data[slot];
  Anchor here = cacheAnchorNow(slot);
  LightReservoir light;
  PathReservoir path;
  if (giWantsDirect()) cacheReadNow(slot, light);
  if (giWantsIndirect()) cacheReadNow(slot, path);
  if (here.isReusable != 0u) {
    Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
    rng.vertex = RL_VERTEX_SPATIAL;
    float cameraDistance = distance(gFrame.camera.posW, here.posW);
    DonorSet donors;
    donors.count = 0u;
    uint attempts = gParams.spatialNeighbours * gParams.spatialTries;
    for (uint i = 0u; i < attempts && donors.count < gParams.spatialNeighbours; i = i + 1u) {
      uint candidate;
      if (!cacheDonorOverSpace(pixel, rng, i, candidate)) continue;
      Anchor there = cacheAnchorNow(candidate);
      if (!cacheAnchorsMatch(here, there, cameraDistance)) continue;
      donors.slot[donors.count] = candidate;
      donors.count = donors.count + 1u;
    }
    real3 estimate;
    if (giWantsDirect()) {
      for (uint k = 0u; k < donors.count; k = k + 1u) {
        donors.confidence[k] = gBuffers.lights.data[donors.slot[k]].state.confidence;
      }
      reuseMerge(light, here, donors, gParams.spatialFlags, rng, RL_DIM_RIS_MERGE_DI, estimate);
      radiance += estimate;
    }
    if (giWantsIndirect()) {
      for (uint k = 0u; k < donors.count; k = k + 1u) {
        donors.confidence[k] = gBuffers.paths.data[donors.slot[k]].state.confidence;
      }
      reuseMerge(path, here, donors, gParams.spatialFlags, rng, RL_DIM_RIS_MERGE_GI, estimate);
      radiance += estimate;
    }
  }
  if (!rlIsFinite3(radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    // A poisoned history would spread: it starts again from nothing here.
    ReservoirState empty;
    empty.W = 0.0f;
    empty.F = vec3(0.0f, 0.0f, 0.0f);
    empty.residual = vec3(0.0f, 0.0f, 0.0f);
    empty.confidence = 1.0f;
    light.state = empty;
    path.state = empty;
  }
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  if (giWantsDirect()) cacheWriteHistory(slot, light);
  if (giWantsIndirect()) cacheWriteHistory(slot, path);
  gBuffers.radiance.data[slot] = radiance;
}
