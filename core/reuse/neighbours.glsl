// Number of spatial donors. The number depends on no sample, so any number is unbiased.
#include "core/reuse/history_length.glsl"

RL_FN bool hasShortHistory() { return gFrame.stillFrames < gParams.reuse.longHistoryFrames; }

RL_FN uint spatialDonors() {
  return hasShortHistory() ? gParams.reuse.spatialNeighbours : gParams.reuse.neighboursLongHistory;
}

// Returns whether two pixels may exchange samples. Old histories exclude outlines: two pixels at an
// outline may differ in every sample, which hurts an old history.
RL_FN bool mayExchange(uint pixelIndex, uint other) {
  if (hasShortHistory()) return true;
  return gBuffers.outlines.data[pixelIndex] == 0u && gBuffers.outlines.data[other] == 0u;
}
