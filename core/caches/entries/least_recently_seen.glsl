// Hash slot that a new cell takes: the one that was not seen for longest. RL_INVALID if all were
// seen in this frame.
RL_FN uint gridLeastRecentlySeen(RL_IN(uvec2) key) {
  uint leastRecent = RL_INVALID;
  uint least = gFrame.frame + 1u;
  for (uint i = 0u; i < gParams.grid.probes; i = i + 1u) {
    uint entry = gridPlace(gParams.grid, key, i);
    uint seen = gBuffers.seen.data[entry];
    if (seen < least) {
      least = seen;
      leastRecent = entry;
    }
  }
  return leastRecent;
}
