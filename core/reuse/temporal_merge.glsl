// Temporal merge of a pixel's reservoir with one of the last frame. The includer has included the
// shift over time already: core/reuse/temporal_shift.glsl or core/reuse/still_shift.glsl.

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

#include "core/resampling/merge_loop.glsl"

// In a still view both samples are of one pixel, with one target: MIS by confidence is exact, and
// needs no shift of the canonical sample.
RL_FN uint temporalMergeFlags(bool isStill) {
  uint flags = gParams.reuse.temporalFlags;
  return isStill ? flags & ~RL_REUSE_PAIRWISE : flags;
}

// Cap of the confidence of a donor: lower where pixels around it hold the same sample, which is
// biased (Lin, Kettunen and Wyman 2026: 1 + (cap - 1) (1 - share^0.1)).
RL_FN float temporalCap(uint previousPixel) {
  float cap = temporalIsStill() ? gParams.reuse.confidenceCap : gParams.reuse.movingConfidenceCap;
  if (gParams.reuse.duplicationMap == 0u) return cap;
  float share = float(gBuffers.duplicates.data[previousPixel]) / RL_DUPLICATES_MOST;
  return 1.0f + (cap - 1.0f) * (1.0f - pow(share, 0.1f));
}

// Merges the reservoir that pixel `previousPixel` had in the last frame, with the share `kept` of
// its confidence, into `here`. In a still view `previousPixel` is the pixel itself. Returns whether
// the donor's sample was selected.
RL_FN bool temporalMerge(uint pixelIndex, uint previousPixel, float kept,
                         RL_INOUT(RL_RESERVOIR) here) {
  bool isStill = temporalIsStill();
  RL_RESERVOIR donor = here;
  if (isStill) {
    donor.state = stateReadPrevious(previousPixel);
  } else {
    donor = reservoirReadPrevious(previousPixel);
  }
  TemporalMerge t;
  t.donor = donor.state;
  t.donor.confidence = reuseCapped(donor.state.confidence, temporalCap(previousPixel));
  t.donor.confidence *= kept;
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  t.u = rngDraw(rng, RL_DIM_RIS_MERGE);
  temporalShift(t, here, donor, pixelIndex, previousPixel);
  uint winner;
  float jacobian;
  reuseMerge(t, 1u, temporalMergeFlags(isStill), here.state, winner, jacobian);
  reservoirGuard(here.state);
  if (winner == RL_INVALID) return false;
  if (isStill) {
    takeSamplePrevious(previousPixel, here);
  } else {
    sampleCopyPath(here, donor);
    sampleAfterShift(here, jacobian);
  }
  return true;
}
