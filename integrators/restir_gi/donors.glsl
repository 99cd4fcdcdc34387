// restir_gi: how many donors over space there are. Known without samples: any number is unbiased.
#include "integrators/restir_gi/age.glsl"

RL_FN bool giIsYoung() { return gFrame.stillFrames < gParams.settledFrames; }

RL_FN uint giDonors() { return giIsYoung() ? gParams.spatialNeighbours : gParams.agedNeighbours; }

// An old history is hurt by what differs from it in every sample, as two pixels at an outline do.
RL_FN bool giMayServe(uint slot, uint other) {
  if (giIsYoung()) return true;
  return gBuffers.outlines.data[slot] == 0u && gBuffers.outlines.data[other] == 0u;
}
