// Pass: resolves claims. The query with the greatest priority gets the hash slot.
// The includer defines entryQuery(), entryVisible(), entryWanted(), which reads no hash slot, and
// entryBegin().
RL_FN void kernelMain(RL_IN(uvec2) at) {
  uint query = entryQuery(at);
  if (query == RL_INVALID) return;
  uint wanted = gBuffers.entries.data[query];
  if (wanted == RL_INVALID || wanted < RL_GRID_CLAIM) return;
  uint entry = wanted & ~RL_GRID_CLAIM;
  if (gBuffers.claims.data[entry] != entryPriority(query)) return;
  GBufferTexel here = entryVisible(query);
  uvec2 key = entryWanted(here);
  gBuffers.seen.data[entry] = gFrame.frame + 1u;
  entryBegin(entry, key, here);
}
