// atrous: reads the result of the previous pass.
RL_FN Filtered atrousRead(uint pixelIndex, uint step) {
  if ((step & 1u) == 0u) return filterRead(gBuffers.even, pixelIndex);
  return filterRead(gBuffers.odd, pixelIndex);
}
