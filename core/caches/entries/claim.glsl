// Pass: askers (queries) without an entry claim a hash slot. The includer defines entryAsker(),
// entryVisible() and entryWanted().
RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint asker = entryAsker(at);
  if (asker == RL_INVALID) return;
  VisibleSurface here = entryVisible(asker);
  if (here.isHit == 0u || gBuffers.entries.data[asker] != RL_INVALID) return;
  uvec2 key = entryWanted(here);
  uint place = gridVictim(key);
  if (place == RL_INVALID || key.x == 0u) return;
  RL_ATOMIC_MAX(gBuffers.claims, place, entryTicket(asker));
  gBuffers.entries.data[asker] = place | RL_GRID_CLAIM;
}
