// What temporal and spatial merges of restir_gi share.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "integrators/restir_gi/store.glsl"
#include "core/caches/cache.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/bridge.glsl"
#include "core/resampling/merge.glsl"
#define RL_ANCHOR Anchor
#define RL_RESERVOIR LightReservoir
#include "core/resampling/reuse.glsl"
#undef RL_RESERVOIR
#define RL_RESERVOIR PathReservoir
#include "core/resampling/reuse.glsl"
#undef RL_RESERVOIR
#undef RL_ANCHOR

RL_FN bool giWantsDirect() { return (gFrame.components & RL_COMPONENT_DIRECT) != 0u; }
RL_FN bool giWantsIndirect() {
  return (gFrame.components & RL_COMPONENT_INDIRECT) != 0u && gFrame.maxBounces >= 2u;
}

// A donor's confidence after the cap, counted when the cap acts.
RL_FN real giCappedConfidence(real confidence) {
  if (confidence > gParams.confidenceCap) {
    RL_HEALTH(RL_HEALTH_CAPPED_CONFIDENCE);
    return gParams.confidenceCap;
  }
  return confidence;
}

// Nothing to merge: no sample and nothing known beyond samples on either side.
RL_FN bool giIsEmpty(RL_IN(ReservoirState) state) {
  return !(state.W > 0.0f) && rlIsBlack(state.residual);
}
