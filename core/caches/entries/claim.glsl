// A pass of new views: a pixel whose surface belongs to no entry asks for a place. The includer
// defines entryWanted().
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  VisibleSurface here = entryVisible(slot);
  if (here.isHit == 0u || gBuffers.entries.data[slot] != RL_INVALID) return;
  uvec2 key = entryWanted(here);
  uint place = gridVictim(key);
  if (place == RL_INVALID || key.x == 0u) return;
  RL_ATOMIC_MAX(gBuffers.claims, place, entryTicket(slot));
  gBuffers.entries.data[slot] = place | RL_GRID_CLAIM;
}
