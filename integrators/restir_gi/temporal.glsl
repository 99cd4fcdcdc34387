// restir_gi, temporal pass: merges the last frame's reservoir of the same surface into the new one,
// then shifts the result to the pixel's partners of the spatial pass.
#include "integrators/restir_gi/merge.glsl"
#define RL_RESERVOIR LightReservoir
#include "integrators/restir_gi/over_time.glsl"
#undef RL_RESERVOIR
#define RL_RESERVOIR PathReservoir
#include "integrators/restir_gi/over_time.glsl"
#undef RL_RESERVOIR

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  Anchor here = cacheAnchorNow(slot);
  if (here.isReusable == 0u) return;
  LightReservoir light;
  PathReservoir path;
  uint donorSlot;
  if (gParams.temporalReuse != 0u && cacheDonorOverTime(here, donorSlot)) {
    Anchor there = cacheAnchorBefore(donorSlot);
    if (cacheAnchorsMatch(here, there, distance(gFrame.camera.posW, here.posW))) {
      Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
      rng.vertex = RL_VERTEX_TEMPORAL;
      float uLight = rngDraw(rng, RL_DIM_RIS_MERGE_DI);
      float uPath = rngDraw(rng, RL_DIM_RIS_MERGE_GI);
      if (giWantsDirect()) giReuseOverTime(slot, here, donorSlot, there, uLight, light);
      if (giWantsIndirect()) giReuseOverTime(slot, here, donorSlot, there, uPath, path);
    }
  }
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner;
    if (cachePartner(pixel, here, k, partner)) {
      Anchor there = cacheAnchorNow(partner);
      if (giWantsDirect()) giShiftToPartner(slot, here, k, there, light);
      if (giWantsIndirect()) giShiftToPartner(slot, here, k, there, path);
    }
    gBuffers.partners.data[cacheExchangeIndex(slot, k)] = partner;
  }
}
