// restir_gi, replay pass over groups of pixels: traces a path of the last frame again.
#include "core/resampling/ris.glsl"
#include "core/caches/entries/groups.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "core/radiance/ends.glsl"
#include "core/payload/path_gather.glsl"
#include "core/payload/path_resample.glsl"
#include "integrators/restir_gi/change.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  uint every = gParams.change.every;
  uint pixels = gFrame.width * gFrame.height;
  if (every == 0u || group * every >= pixels) return;
  float difference = 0.0f;
  float greater = 0.0f;
  uint last = gFrame.frame - 1u;
  uint slot = groupTurn(group, every, last);
  if (gBuffers.found.data[2u * group + 1u] == giReplayTag(last)) {
    uvec2 pixel = pixelOfSlot(slot);
    uint film = cameraFilmBitsOfFrame(pixel, last);
    PathGather p = pathNothingGathered(film);
    Rng rng = rngInit(gFrame.seed, slot, last);
    Walk walk = walkBegin(rng, film, cameraFilmRay(gFrame.previousCamera, pixel, film), 0u);
    walkOn(p, walk);
    float now = giLuminance(p, pathResample(p, rng));
    float before = uintBitsToFloat(gBuffers.found.data[2u * group]);
    if (rlIsFinite(now)) {
      greater = max(now, before);
      difference = abs(now - before);
      if (difference <= RL_GI_SAME * (now + before)) difference = 0.0f;
    }
  }
  gBuffers.differences.data[2u * group] = floatBitsToUint(difference);
  gBuffers.differences.data[2u * group + 1u] = floatBitsToUint(greater);
}
