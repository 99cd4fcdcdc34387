// restir_gi, initial pass: traces the pixel's path and makes a reservoir of it. In a still view the
// last frame's sample is one of the same pixel and is merged here. Light that no other pixel could
// reuse (mirrors, glass, lights in view) is averaged over time alone.
#include "core/resampling/ris.glsl"
#include "core/caches/entries/entries.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "core/radiance/ends.glsl"
#include "core/payload/path_gather.glsl"
#include "core/payload/path_resample.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/over_time.glsl"
#include "integrators/restir_gi/age.glsl"
#include "integrators/restir_gi/change.glsl"

// Temporal merge in a still view: the shift is the identity, for every surface and path. Both are
// samples of one pixel, with one target, so MIS weights by confidence are exact.
RL_FN void giMergeStillView(uint slot, float kept, RL_INOUT(PathReservoir) r) {
  ReservoirState donor = giReadStateBefore(slot);
  GiOverTime t;
  giBeginOverTime(t, donor, slot);
  t.donor.confidence *= kept;
  t.ours = mergeUnshifted(r.state);
  t.theirs = mergeUnshifted(donor);
  t.ratio = vec3(1.0f, 1.0f, 1.0f);
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, gParams.temporalFlags & ~RL_REUSE_PAIRWISE, r.state, winner, jacobian);
  reservoirGuard(r.state);
  if (winner != RL_INVALID) giTakePathBefore(slot, r);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = pixel.y * gFrame.width + pixel.x;
  uint film = cameraFilmBits(pixel);
  PathGather p = pathNothingGathered(film);
  p.end = radianceBegin(slot);
  walkPath(p, pixel, film);
  PathReservoir r = pathResample(p, rngInit(gFrame.seed, slot, gFrame.frame));
  vec3 estimate = r.state.F * r.state.W + r.state.residual;
  vec3 own = p.ownLight + p.inView;
  GiOwnCount count = giOwnCount(0u);
  if (gFrame.stillFrames == 0u) {
    uvec4 inView = RL_PAST_QUAD(gBuffers.own, slot);
    count = giOwnCount(inView.w);
    if (count.taken != 0u) own = p.ownLight + recordVec3(inView);
  }
  if (!rlIsFinite3(own) || !rlIsFinite3(estimate)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    own = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  PathReservoir offer = r;
  if (gParams.temporalReuse != 0u && gFrame.stillFrames != 0u) {
    float kept = giKept(slot);
    uvec4 before = RL_PAST_QUAD(gBuffers.ownBefore, slot);
    count = giOwnCount(before.w);
    if (kept < 1.0f) {
      count.taken = 0u;
      count.frames = uint(float(count.frames) * kept);
    }
    // lights_in_view took this frame's film sample already, in the first frame of the view.
    float weight = 1.0f / (min(float(count.frames), gParams.confidenceCap) + 1.0f);
    if (gFrame.stillFrames < count.taken) weight = 0.0f;
    own = recordVec3(before) * (1.0f - weight) + own * weight;
    if (kept > 0.0f) giMergeStillView(slot, kept, r);
  }
  giWriteNow(slot, r);
  bool isOffered = gParams.entries.count != 0u && entryOfferer(entryGroup(slot)) == slot;
  if (isOffered && gFrame.stillFrames != 0u) giWriteHistory(slot, offer);
  count.frames = min(count.frames + 1u, 0xffffffu);
  RL_WRITE_QUAD(gBuffers.own, slot, recordQuad(own, giOwnWord(count)));
}
