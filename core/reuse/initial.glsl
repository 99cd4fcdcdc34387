// Initial pass: traces the pixel's path and makes a reservoir of it. In a still view the
// last frame's sample is one of the same pixel and is merged here. Light that the reservoir leaves
// out (of mirrors, glass, lights in view) is averaged over time alone.
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/still_shift.glsl"
#include "core/reuse/temporal_merge.glsl"
#include "core/reuse/history_length.glsl"
#include "core/reuse/history_kept.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  vec3 specularLight;  // of mirrors and glass at x1, and all else that the reservoir leaves out
  vec3 lightInView;    // of a lamp, and of its images in mirrors
  RL_RESERVOIR r = sampleInitial(pixel, film, specularLight, lightInView);
  vec3 estimate = r.state.F * r.state.W + r.state.residual;
  vec3 unresampled = specularLight + lightInView;
  UnresampledCount count = unresampledCountUnpack(0u);
  if (!viewIsStill()) {
    uvec4 ofEdges = RL_EARLIER_UVEC4(gBuffers.unresampled, pixelIndex);
    count = unresampledCountUnpack(ofEdges.w);
    if (count.taken != 0u) {
      lightInView = recordVec3(ofEdges);
      unresampled = specularLight + lightInView;
      if (count.frames != 0u) count.taken = 0u;
      count.frames = 0u;
    }
  }
  if (!rlIsFinite3(unresampled) || !rlIsFinite3(estimate)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    unresampled = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  RL_RESERVOIR candidate = r;
  if (gParams.reuse.temporalReuse != 0u && viewIsStill()) {
    float kept = historyKept(pixelIndex);
    uvec4 previous = RL_EARLIER_UVEC4(gBuffers.unresampledPrevious, pixelIndex);
    count = unresampledCountUnpack(previous.w);
    if (kept < 1.0f) {
      count.taken = 0u;
      count.frames = uint(float(count.frames) * kept);
    }
    // light_edges took this frame's film sample already, in the first frame of the view.
    float weight = 1.0f / (min(float(count.frames), gParams.reuse.confidenceCap) + 1.0f);
    if (viewIsYoungerThan(count.taken)) weight = 0.0f;
    unresampled = recordVec3(previous) * (1.0f - weight) + unresampled * weight;
    if (kept > 0.0f) temporalMerge(pixelIndex, pixelIndex, kept, r);
  }
  reservoirWriteNow(pixelIndex, r);
  // One pixel of each group inserts this frame's candidate into its entry. In a still view
  // `reservoirs` holds the merge already, so the candidate goes where the history was.
  bool feedsEntry =
      gParams.entries.count != 0u && entryCandidatePixel(entryGroup(pixelIndex)) == pixelIndex;
  if (feedsEntry && viewIsStill()) reservoirWriteHistory(pixelIndex, candidate);
  count.frames = min(count.frames + 1u, 0xffffu);
  count.level = levelOfLight(lightInView);
  RL_WRITE_UVEC4(gBuffers.unresampled, pixelIndex,
                 recordUvec4(unresampled, unresampledCountPack(count)));
}
