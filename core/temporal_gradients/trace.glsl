// Pass over groups of pixels: one pixel of each group traces a path of the last frame again, with
// that frame's camera and random numbers. If the result differs by more than rounding, the light of
// the scene has changed: noise is never taken for a change. Then the pixel traces a path of this
// frame, for comparison in the next one (temporal gradients: Schied, Peters and Dachsbacher,
// "Gradient Estimation for Real-Time Adaptive Temporal Filtering", 2018).
#define RL_WALK_STATE ChangeWalk
#include "core/caches/entries/groups.glsl"

RL_FN uint onVertex(RL_INOUT(ChangeWalk) state, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  return 1u;
}

#include "core/transport/light_sum.glsl"

// Tag of a path's frame and settings: other settings would draw other samples.
RL_FN uint changeTag(uint frame) { return rngHash(frame ^ rngHash(gParams.changes.every)); }

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  uint every = gParams.changes.every;
  if (every == 0u || group * every >= gFrame.width * gFrame.height) return;
  float before = uintBitsToFloat(gBuffers.found.data[2u * group]);
  bool isKnown = gBuffers.found.data[2u * group + 1u] == changeTag(gFrame.frame - 1u);
  float difference = 0.0f;
  float greater = 0.0f;
  for (uint i = isKnown ? 0u : 1u; i < 2u; i = i + 1u) {
    uint frame = gFrame.frame - 1u + i;
    uint pixelIndex = groupRoundRobin(group, every, frame);
    uvec2 pixel = pixelOfIndex(pixelIndex);
    uint film = cameraFilmBitsOfFrame(pixel, frame);
    Camera camera = gFrame.camera;
    if (i == 0u) camera = gFrame.previousCamera;
    ChangeWalk state;
    state.sum = lightSumNone();
    // Use separate random numbers: what a history keeps must not depend on the pixel's own draws.
    Rng rng = rngInit(gFrame.seed ^ RL_CHANGE_SEED, pixelIndex, frame);
    Walk walk = walkBegin(rng, film, cameraFilmRay(camera, pixel, film), 0u);
    walkOn(state, walk);
    float luminance = rlLuminance(state.sum.radiance);
    if (!rlIsFinite(luminance)) luminance = 0.0f;
    if (i == 0u) {
      greater = max(luminance, before);
      difference = abs(luminance - before);
      if (difference <= RL_CHANGE_SAME * (luminance + before)) difference = 0.0f;
    } else {
      gBuffers.found.data[2u * group] = floatBitsToUint(luminance);
      gBuffers.found.data[2u * group + 1u] = changeTag(frame);
    }
  }
  gBuffers.differences.data[2u * group] = floatBitsToUint(difference);
  gBuffers.differences.data[2u * group + 1u] = floatBitsToUint(greater);
}
