// Initial pass: traces the pixel's path and makes a reservoir of it. In a still view the
// last frame's sample is one of the same pixel and is merged here. Light that no other pixel could
// reuse (mirrors, glass, lights in view) is averaged over time alone.
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/still_shift.glsl"
#include "core/reuse/temporal_merge.glsl"
#include "core/reuse/history_length.glsl"
#include "core/reuse/history_weight.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  vec3 unresampled;
  vec3 seenDirectly;
  RL_RESERVOIR r = sampleInitial(pixel, film, unresampled, seenDirectly);
  vec3 estimate = r.state.F * r.state.W + r.state.residual;
  vec3 own = unresampled + seenDirectly;
  ViewLight count = viewLightUnpack(0u);
  if (gFrame.stillFrames == 0u) {
    uvec4 inView = RL_PAST_QUAD(gBuffers.unresampled, pixelIndex);
    count = viewLightUnpack(inView.w);
    if (count.taken != 0u) own = unresampled + recordVec3(inView);
  }
  if (!rlIsFinite3(own) || !rlIsFinite3(estimate)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    own = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  RL_RESERVOIR candidate = r;
  if (gParams.reuse.temporalReuse != 0u && gFrame.stillFrames != 0u) {
    float kept = historyWeight(pixelIndex);
    uvec4 before = RL_PAST_QUAD(gBuffers.unresampledBefore, pixelIndex);
    count = viewLightUnpack(before.w);
    if (kept < 1.0f) {
      count.taken = 0u;
      count.frames = uint(float(count.frames) * kept);
    }
    // lights_in_view took this frame's film sample already, in the first frame of the view.
    float weight = 1.0f / (min(float(count.frames), gParams.reuse.confidenceCap) + 1.0f);
    if (gFrame.stillFrames < count.taken) weight = 0.0f;
    own = recordVec3(before) * (1.0f - weight) + own * weight;
    if (kept > 0.0f) temporalMerge(pixelIndex, pixelIndex, kept, r);
  }
  reservoirWriteNow(pixelIndex, r);
  bool isCandidate =
      gParams.entries.count != 0u && entryCandidatePixel(entryGroup(pixelIndex)) == pixelIndex;
  if (isCandidate && gFrame.stillFrames != 0u) reservoirWriteHistory(pixelIndex, candidate);
  count.frames = min(count.frames + 1u, 0xffffffu);
  RL_WRITE_QUAD(gBuffers.unresampled, pixelIndex, recordQuad(own, viewLightPack(count)));
}
