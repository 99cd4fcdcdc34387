// A pass of new views: the entry that a pixel's surface belongs to. The includer defines
// entryNear().
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  VisibleSurface here = entryVisible(slot);
  uint entry = RL_INVALID;
  if (here.isHit != 0u) entry = entryOwn(here);
  if (entry != RL_INVALID) RL_ATOMIC_MAX(gBuffers.seen, entry, gFrame.frame + 1u);
  gBuffers.entries.data[slot] = entry;
}
