// restir_gi: temporal merge of a slot's reservoir with the one of the last frame.
#define RL_REUSE_STATE GiOverTime

RL_FN bool reuseDonor(RL_IN(GiOverTime) t, uint k, RL_OUT(ReservoirState) donor) {
  donor = t.donor;
  return true;
}
RL_FN Shifted reuseOurs(RL_IN(GiOverTime) t, uint k) { return t.ours; }
RL_FN Shifted reuseTheirs(RL_IN(GiOverTime) t, uint k) { return t.theirs; }
RL_FN real3 reuseRatio(RL_IN(GiOverTime) t, uint k) { return t.ratio; }
RL_FN real reuseUniform(RL_IN(GiOverTime) t, uint k) { return t.u; }

#include "core/resampling/reuse.glsl"

// Sets the donor, with its confidence capped, and draws the random number of the merge.
RL_FN void giBeginOverTime(RL_INOUT(GiOverTime) t, RL_IN(ReservoirState) donor, uint slot) {
  t.donor = donor;
  t.donor.confidence =
      reuseCapped(donor.confidence,
                  gFrame.stillFrames != 0u ? gParams.confidenceCap : gParams.movingConfidenceCap);
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  rng.vertex = RL_VERTEX_TEMPORAL;
  t.u = rngDraw(rng, RL_DIM_RIS_MERGE);
}
