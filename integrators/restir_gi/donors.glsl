// restir_gi: number of spatial donors. Independent of samples: any number is unbiased.
#include "integrators/restir_gi/age.glsl"

RL_FN bool giIsYoung() { return gFrame.stillFrames < gParams.settledFrames; }

RL_FN uint giDonors() { return giIsYoung() ? gParams.spatialNeighbours : gParams.agedNeighbours; }

// Returns whether two pixels may exchange samples. Old histories exclude outlines: two pixels at an
// outline may differ in every sample, which hurts an old history.
RL_FN bool giMayServe(uint slot, uint other) {
  if (giIsYoung()) return true;
  return gBuffers.outlines.data[slot] == 0u && gBuffers.outlines.data[other] == 0u;
}
