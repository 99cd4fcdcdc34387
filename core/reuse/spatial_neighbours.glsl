// Spatial donors. Their number depends on no sample, so any number is unbiased.
#include "core/reuse/history_length.glsl"

RL_FN bool historyIsYoung() { return viewIsYoungerThan(gParams.reuse.youngFrames); }

RL_FN uint spatialDonors() {
  return historyIsYoung() ? gParams.reuse.spatialNeighbours : gParams.reuse.agedNeighbours;
}

RL_FN bool isLastRound() { return gParams.reuse.spatialRound + 1u == gParams.reuse.spatialRounds; }

// Finds the k-th neighbour of a round (pairFind()). Each round has pairs of its own.
RL_FN bool spatialNeighbour(RL_IN(uvec2) pixel, uint k, RL_OUT(uint) neighbour) {
  return pairFind(pixel, k + RL_MAX_DONORS * gParams.reuse.spatialRound, neighbour);
}

// Returns whether two pixels may exchange samples. At an outline a neighbour's integrand
// may differ from the pixel's in every sample. A young history gains more by one more sample than
// that costs. An old one has averaged its own noise away, and the difference would be its largest
// error: it does not exchange there.
RL_FN bool mayExchange(uint pixelIndex, uint other) {
  if (historyIsYoung()) return true;
  return gBuffers.outlines.data[pixelIndex] == 0u && gBuffers.outlines.data[other] == 0u;
}
