// Pass: queries without an entry claim a hash slot. The includer defines entryQuery(),
// entryVisible() and entryWanted().
RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint query = entryQuery(at);
  if (query == RL_INVALID) return;
  GBufferTexel here = entryVisible(query);
  if (here.isHit == 0u || gBuffers.entries.data[query] != RL_INVALID) return;
  uvec2 key = entryWanted(here);
  uint place = gridLeastRecentlySeen(key);
  if (place == RL_INVALID || key.x == 0u) return;
  RL_ATOMIC_MAX(gBuffers.claims, place, entryPriority(query));
  gBuffers.entries.data[query] = place | RL_GRID_CLAIM;
}
