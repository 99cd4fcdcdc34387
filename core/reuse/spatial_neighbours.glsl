// Number of spatial donors. The number depends on no sample, so any number is unbiased.
#include "core/reuse/history_length.glsl"

RL_FN bool historyIsYoung() { return viewIsYoungerThan(gParams.reuse.youngFrames); }

RL_FN uint spatialDonors() {
  return historyIsYoung() ? gParams.reuse.spatialNeighbours : gParams.reuse.agedNeighbours;
}

// Returns whether two pixels may exchange samples. At an outline a neighbour's integrand
// may differ from the pixel's in every sample. A young history gains more by one more sample than
// that costs. An old one has averaged its own noise away, and the difference would be its largest
// error: it does not exchange there.
RL_FN bool mayExchange(uint pixelIndex, uint other) {
  if (historyIsYoung()) return true;
  return gBuffers.outlines.data[pixelIndex] == 0u && gBuffers.outlines.data[other] == 0u;
}
