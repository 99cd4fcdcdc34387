// Caches whose askers are pixels, with what their centres show.
RL_FN uint entryAsker(RL_IN(uvec2) pixel) { return slotOfPixel(pixel); }
RL_FN VisibleSurface entryVisible(uint slot) {
  return visibleRead(gBuffers.visible, gFrame.camera, slot);
}
