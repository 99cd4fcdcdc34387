// The entry that an asker's surface belongs to. The includer of this and of the two passes defines
// entryAsker(), entryVisible() and entryOwn().
RL_FN void entryLook(uint asker) {
  VisibleSurface here = entryVisible(asker);
  uint entry = RL_INVALID;
  if (here.isHit != 0u) entry = entryOwn(here);
  if (entry != RL_INVALID) RL_ATOMIC_MAX(gBuffers.seen, entry, gFrame.frame + 1u);
  gBuffers.entries.data[asker] = entry;
}
