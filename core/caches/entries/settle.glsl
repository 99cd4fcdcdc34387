// A pass: a place goes to the asker with the greatest ticket of those who want it. The includer
// defines entryAsker(), entryVisible(), entryWanted(), which looks at no place, and entryBegin().
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
