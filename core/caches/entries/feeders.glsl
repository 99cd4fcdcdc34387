// Pass of every frame: selects which groups' samples go into which entries.
RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  uint group = entryGroup(slot);
  if (entryOfferer(group) != slot) return;
  uint entry = gBuffers.entries.data[slot];
  if (entry >= RL_GRID_CLAIM) return;
  Anchor anchor = anchorRead(gBuffers.anchors, entry);
  if (anchor.surface.isHit != 0u &&
      !visibleAlike(entryVisible(slot), anchor.surface, gParams.alike))
    return;
  groupFeeds(gBuffers.feeders, entry, group);
}
