// Temporal merge of a pixel's reservoir with one of the last frame. In a still view both are
// samples of one pixel: the shift is the identity and traces nothing.
#include "core/reuse/reflectance_ratio.glsl"

#define RL_REUSE_STATE TemporalMerge

RL_FN bool reuseDonor(RL_IN(TemporalMerge) t, uint k, RL_OUT(ReservoirState) donor) {
  donor = t.donor;
  return true;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(TemporalMerge) t, uint k) {
  return t.canonicalAtNeighbour;
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(TemporalMerge) t, uint k) {
  return t.neighbourAtCanonical;
}
RL_FN real3 reuseRatio(RL_IN(TemporalMerge) t, uint k) { return t.ratio; }
RL_FN real reuseUniform(RL_IN(TemporalMerge) t, uint k) { return t.u; }

#include "core/resampling/reuse.glsl"

// Shifts the pixel's own sample to the donor's pixel in the last frame, then the donor's sample to
// this pixel.
RL_FN void temporalShift(RL_INOUT(TemporalMerge) t, RL_IN(RL_RESERVOIR) here,
                         RL_IN(RL_RESERVOIR) donor, uint pixelIndex, uint before) {
  uint flags = gParams.reuse.temporalFlags;
  t.ratio = pixelReflectanceRatio(
      visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before), pixelIndex);
  RL_SHIFT shift =
      shiftTo(here, pixelOfIndex(before), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
  RL_RESERVOIR moved = here;
  t.canonicalAtNeighbour = shift.shifted;
  for (uint i = 0u; i < 2u; i = i + 1u) {
    if (i == 1u) {
      t.canonicalAtNeighbour = shift.shifted;
      shift = shiftTo(donor, pixelOfIndex(pixelIndex), false,
                      (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u);
      moved = donor;
    }
    shiftTrace(shift, moved);
  }
  t.neighbourAtCanonical = shift.shifted;
}

// Merges the reservoir that pixel `before` had in the last frame, with the share `kept` of its
// confidence, into `here`. In a still view `before` is the pixel itself, and both samples have one
// target: MIS weights by confidence are exact. Returns whether the donor's sample was selected.
RL_FN bool temporalMerge(uint pixelIndex, uint before, float kept, bool isStill,
                         RL_INOUT(RL_RESERVOIR) here) {
  RL_RESERVOIR donor = here;
  if (isStill) {
    donor.state = stateReadBefore(before);
  } else {
    reservoirReadBefore(before, donor);
  }
  TemporalMerge t;
  t.donor = donor.state;
  t.donor.confidence =
      reuseCapped(donor.state.confidence,
                  isStill ? gParams.reuse.confidenceCap : gParams.reuse.movingConfidenceCap);
  t.donor.confidence *= kept;
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  t.u = rngDraw(rng, RL_DIM_RIS_MERGE);
  uint flags = gParams.reuse.temporalFlags;
  if (isStill) {
    flags = flags & ~RL_REUSE_PAIRWISE;
    t.canonicalAtNeighbour = mergeUnshifted(here.state);
    t.neighbourAtCanonical = mergeUnshifted(donor.state);
    t.ratio = vec3(1.0f, 1.0f, 1.0f);
  } else {
    temporalShift(t, here, donor, pixelIndex, before);
  }
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, flags, here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner == RL_INVALID) return false;
  if (isStill) {
    takeSampleBefore(before, here);
  } else {
    sampleTake(here, donor);
    sampleFollow(here, jacobian);
  }
  return true;
}
