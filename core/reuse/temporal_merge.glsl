// Temporal merge of a pixel's reservoir with one of the last frame. The includer has included the
// shift over time before: core/reuse/temporal_shift.glsl or core/reuse/still_shift.glsl.

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

// Merges the reservoir that pixel `before` had in the last frame, with the share `kept` of its
// confidence, into `here`. In a still view `before` is the pixel itself. Returns whether the
// donor's sample was selected.
RL_FN bool temporalMerge(uint pixelIndex, uint before, float kept, RL_INOUT(RL_RESERVOIR) here) {
  bool isStill = temporalIsStill();
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
  if (isStill) flags = flags & ~RL_REUSE_PAIRWISE;
  temporalShift(t, here, donor, pixelIndex, before);
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
