// A pass of new views: a place goes to the pixel with the greatest ticket of those who want it. The
// includer defines entryWanted(), which
// looks at no place, and entryBegin().
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  uint wanted = gBuffers.entries.data[slot];
  if (wanted == RL_INVALID || wanted < RL_GRID_CLAIM) return;
  uint entry = wanted & ~RL_GRID_CLAIM;
  if (gBuffers.claims.data[entry] != entryTicket(slot)) return;
  VisibleSurface here = entryVisible(slot);
  uvec2 key = entryWanted(here);
  gBuffers.keys.data[2u * entry] = key.x;
  gBuffers.keys.data[2u * entry + 1u] = key.y;
  gBuffers.seen.data[entry] = gFrame.frame + 1u;
  anchorWrite(gBuffers.anchors, entry, anchorNone());
  entryBegin(entry, here);
}
