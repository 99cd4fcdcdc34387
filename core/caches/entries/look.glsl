// Lookup of the entry that an asker's (query's) surface belongs to. The includer of this file and
// of find.glsl and find_again.glsl defines entryAsker(), entryVisible() and entryOwn().
RL_FN void entryLook(uint asker) {
  VisibleSurface here = entryVisible(asker);
  uint entry = RL_INVALID;
  if (here.isHit != 0u) entry = entryOwn(here);
  if (entry != RL_INVALID) RL_ATOMIC_MAX(gBuffers.seen, entry, gFrame.frame + 1u);
  gBuffers.entries.data[asker] = entry;
}
