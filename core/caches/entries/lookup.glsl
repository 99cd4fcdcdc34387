// Lookup of the entry that a query's surface belongs to. The includer of this file and
// of find.glsl and find_after_claims.glsl defines entryQuery(), entryVisible() and entryOwn().
RL_FN void entryLook(uint query) {
  GBufferTexel here = entryVisible(query);
  uint entry = RL_INVALID;
  if (here.isHit != 0u) entry = entryOwn(here);
  if (entry != RL_INVALID) RL_ATOMIC_MAX(gBuffers.seen, entry, gFrame.frame + 1u);
  gBuffers.entries.data[query] = entry;
}
