// Caches whose askers (queries) are pixels, by the surfaces at their centres.
RL_FN uint entryAsker(RL_IN(uvec2) pixel) { return slotOfPixel(pixel); }
RL_FN VisibleSurface entryVisible(uint slot) {
  return visibleRead(gBuffers.visible, gFrame.camera, slot);
}
