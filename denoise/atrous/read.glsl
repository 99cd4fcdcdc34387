// atrous: reads the result of the previous pass.
RL_FN Filtered atrousRead(uint slot, uint step) {
  if ((step & 1u) == 0u) return filterRead(gBuffers.even, slot);
  return filterRead(gBuffers.odd, slot);
}
