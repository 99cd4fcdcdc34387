// atrous: what the pass before left.
RL_FN Filtered atrousRead(uint slot, uint step) {
  if ((step & 1u) == 0u) return filterRead(gBuffers.even, slot);
  return filterRead(gBuffers.odd, slot);
}
