// Pass: resolves claims. The asker (query) with the greatest ticket (priority) gets the hash slot.
// The includer defines entryAsker(), entryVisible(), entryWanted(), which reads no hash slot, and
// entryBegin().
RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint asker = entryAsker(at);
  if (asker == RL_INVALID) return;
  uint wanted = gBuffers.entries.data[asker];
  if (wanted == RL_INVALID || wanted < RL_GRID_CLAIM) return;
  uint entry = wanted & ~RL_GRID_CLAIM;
  if (gBuffers.claims.data[entry] != entryTicket(asker)) return;
  VisibleSurface here = entryVisible(asker);
  uvec2 key = entryWanted(here);
  gBuffers.seen.data[entry] = gFrame.frame + 1u;
  entryBegin(entry, key, here);
}
