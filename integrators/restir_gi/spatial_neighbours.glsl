// restir_gi: number of spatial donors. Independent of samples: any number is unbiased.
#include "integrators/restir_gi/history_length.glsl"

RL_FN bool giHasShortHistory() { return gFrame.stillFrames < gParams.longHistoryFrames; }

RL_FN uint giDonors() {
  return giHasShortHistory() ? gParams.spatialNeighbours : gParams.neighboursLongHistory;
}

// Returns whether two pixels may exchange samples. Old histories exclude outlines: two pixels at an
// outline may differ in every sample, which hurts an old history.
RL_FN bool giMayServe(uint pixelIndex, uint other) {
  if (giHasShortHistory()) return true;
  return gBuffers.outlines.data[pixelIndex] == 0u && gBuffers.outlines.data[other] == 0u;
}
