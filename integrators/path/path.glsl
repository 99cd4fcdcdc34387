// path, the baseline. One path per pixel and frame; at each vertex one light sample and one BSDF
// sample, combined by the power heuristic (Veach 1997, chapter 9). Unbiased, unless paths end in
// radiance cells.
#define RL_WALK_STATE PathState
#include "core/caches/entries/groups.glsl"
#include "core/radiance_cache/termination.glsl"

RL_FN void onEnd(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_IN(Surface) s,
                 RL_IN(vec3) radiance) {
  state.sum.radiance += walk.throughput * radiance;
}
RL_FN uint onVertex(RL_INOUT(PathState) state, RL_IN(Walk) walk, RL_INOUT(Surface) s) { return 1u; }

#include "core/transport/light_sum.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  PathState state;
  state.sum = lightSumNone();
  state.end = cacheTerminationBegin(pixelIndex);
  walkPath(state, pixel, cameraFilmBits(pixel));
  if (!rlIsFinite3(state.sum.radiance)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    state.sum.radiance = vec3(0.0f, 0.0f, 0.0f);
  }
  gBuffers.radiance.data[pixelIndex] = state.sum.radiance;
}
