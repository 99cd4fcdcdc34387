// pixel_outlines: which pixels show the outline of a surface, as far as the centres of the four
// pixels beside them tell. Two pixels there may differ in every sample.

RL_FN bool outlineTowards(RL_IN(uvec2) pixel, RL_IN(VisibleSurface) here, int dx, int dy) {
  int x = int(pixel.x) + dx;
  int y = int(pixel.y) + dy;
  if (x < 0 || y < 0 || x >= int(gFrame.width) || y >= int(gFrame.height)) return false;
  return !cacheSurfacesMatch(here, cacheSurface(cacheSlot(uvec2(uint(x), uint(y)))));
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  VisibleSurface here = cacheSurface(slot);
  bool isOutline = outlineTowards(pixel, here, -1, 0) || outlineTowards(pixel, here, 1, 0) ||
                   outlineTowards(pixel, here, 0, -1) || outlineTowards(pixel, here, 0, 1);
  gCache.outlines.data[slot] = isOutline ? 1u : 0u;
}
