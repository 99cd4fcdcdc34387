// restir_gi, initial pass: traces the pixel's path and makes a reservoir of it. In a still view the
// last frame's sample is one of the same pixel and is merged here. Light that no other pixel could
// reuse (mirrors, glass, lights in view) is averaged over time alone.
#include "core/resampling/ris.glsl"
#include "core/caches/entries/entries.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "integrators/restir_gi/reservoir_store.glsl"
#include "integrators/restir_gi/temporal_merge.glsl"
#include "integrators/restir_gi/history_length.glsl"
#include "integrators/restir_gi/history_weight.glsl"

// Temporal merge in a still view: the shift is the identity, for every surface and path. Both are
// samples of one pixel, with one target, so MIS weights by confidence are exact.
RL_FN void giMergeStillView(uint pixelIndex, float kept, RL_INOUT(PathReservoir) r) {
  ReservoirState donor = giReadStateBefore(pixelIndex);
  GiTemporalMerge t;
  giBeginTemporalMerge(t, donor, pixelIndex);
  t.donor.confidence *= kept;
  t.canonicalAtNeighbour = mergeUnshifted(r.state);
  t.neighbourAtCanonical = mergeUnshifted(donor);
  t.ratio = vec3(1.0f, 1.0f, 1.0f);
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, gParams.temporalFlags & ~RL_REUSE_PAIRWISE, r.state, winner, jacobian);
  reservoirGuard(r.state);
  if (winner != RL_INVALID) giTakePathBefore(pixelIndex, r);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  PathRecord p = pathRecordEmpty(film);
  p.end = cacheTerminationBegin(pixelIndex);
  walkPath(p, pixel, film);
  PathReservoir r = pathResample(p, rngInit(gFrame.seed, pixelIndex, gFrame.frame));
  vec3 estimate = r.state.F * r.state.W + r.state.residual;
  vec3 own = p.unresampledRadiance + p.inView;
  GiViewLight count = giViewLight(0u);
  if (gFrame.stillFrames == 0u) {
    uvec4 inView = RL_PAST_QUAD(gBuffers.unresampled, pixelIndex);
    count = giViewLight(inView.w);
    if (count.taken != 0u) own = p.unresampledRadiance + recordVec3(inView);
  }
  if (!rlIsFinite3(own) || !rlIsFinite3(estimate)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    own = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  PathReservoir candidate = r;
  if (gParams.temporalReuse != 0u && gFrame.stillFrames != 0u) {
    float kept = giHistoryWeight(pixelIndex);
    uvec4 before = RL_PAST_QUAD(gBuffers.unresampledBefore, pixelIndex);
    count = giViewLight(before.w);
    if (kept < 1.0f) {
      count.taken = 0u;
      count.frames = uint(float(count.frames) * kept);
    }
    // lights_in_view took this frame's film sample already, in the first frame of the view.
    float weight = 1.0f / (min(float(count.frames), gParams.confidenceCap) + 1.0f);
    if (gFrame.stillFrames < count.taken) weight = 0.0f;
    own = recordVec3(before) * (1.0f - weight) + own * weight;
    if (kept > 0.0f) giMergeStillView(pixelIndex, kept, r);
  }
  giWriteNow(pixelIndex, r);
  bool isCandidate =
      gParams.entries.count != 0u && entryCandidatePixel(entryGroup(pixelIndex)) == pixelIndex;
  if (isCandidate && gFrame.stillFrames != 0u) giWriteHistory(pixelIndex, candidate);
  count.frames = min(count.frames + 1u, 0xffffffu);
  RL_WRITE_QUAD(gBuffers.unresampled, pixelIndex, recordQuad(own, giViewLightWord(count)));
}
