// restir_gi, spatial pass: merges partners' temporal reservoirs, shades, and leaves the history. It
// traces no ray: the shifts between partners were made by the temporal pass.
#include "integrators/restir_gi/merge.glsl"
#define RL_RESERVOIR LightReservoir
#include "integrators/restir_gi/over_space.glsl"
#undef RL_RESERVOIR
#define RL_RESERVOIR PathReservoir
#include "integrators/restir_gi/over_space.glsl"
#undef RL_RESERVOIR

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  vec3 radiance = gBuffers.ownLight.data[slot];
  Anchor here = cacheAnchorNow(slot);
  if (here.isReusable != 0u) {
    Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
    rng.vertex = RL_VERTEX_SPATIAL;
    LightReservoir light;
    PathReservoir path;
    if (giWantsDirect()) radiance += giReuseOverSpace(slot, here, rng, RL_DIM_RIS_MERGE_DI, light);
    if (giWantsIndirect()) radiance += giReuseOverSpace(slot, here, rng, RL_DIM_RIS_MERGE_GI, path);
  }
  if (!rlIsFinite3(radiance)) {
    // A poisoned history would spread: it starts again from nothing here.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    LightReservoir light;
    PathReservoir path;
    light.state.W = 0.0f;
    light.state.F = vec3(0.0f, 0.0f, 0.0f);
    light.state.residual = vec3(0.0f, 0.0f, 0.0f);
    light.state.confidence = 1.0f;
    path.state = light.state;
    if (giWantsDirect()) cacheWriteStateHistory(slot, light);
    if (giWantsIndirect()) cacheWriteStateHistory(slot, path);
  }
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[slot] = radiance;
}
