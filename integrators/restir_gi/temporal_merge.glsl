// restir_gi: temporal merge of a pixel's reservoir with the one of the last frame.
#define RL_REUSE_STATE GiTemporalMerge

RL_FN bool reuseDonor(RL_IN(GiTemporalMerge) t, uint k, RL_OUT(ReservoirState) donor) {
  donor = t.donor;
  return true;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(GiTemporalMerge) t, uint k) {
  return t.canonicalAtNeighbour;
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(GiTemporalMerge) t, uint k) {
  return t.neighbourAtCanonical;
}
RL_FN real3 reuseRatio(RL_IN(GiTemporalMerge) t, uint k) { return t.ratio; }
RL_FN real reuseUniform(RL_IN(GiTemporalMerge) t, uint k) { return t.u; }

#include "core/resampling/reuse.glsl"

// Sets the donor, with its confidence capped, and draws the random number of the merge.
RL_FN void giBeginTemporalMerge(RL_INOUT(GiTemporalMerge) t, RL_IN(ReservoirState) donor,
                                uint pixelIndex) {
  t.donor = donor;
  t.donor.confidence =
      reuseCapped(donor.confidence,
                  gFrame.stillFrames != 0u ? gParams.confidenceCap : gParams.movingConfidenceCap);
  Rng rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  t.u = rngDraw(rng, RL_DIM_RIS_MERGE);
}
