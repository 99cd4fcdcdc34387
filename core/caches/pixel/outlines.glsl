// pixel_outlines: which pixels show the outline of a surface, as far as the centres of the four
// pixels beside them tell. Two pixels there may differ in every sample.

// Left of column 0 and above row 0 the number wraps to the largest there is, which is outside, too.
RL_FN bool differsFrom(RL_IN(VisibleSurface) here, uint x, uint y) {
  if (x >= gFrame.width || y >= gFrame.height) return false;
  return !cacheSurfacesMatch(here, cacheSurface(cacheSlot(uvec2(x, y))));
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  VisibleSurface here = cacheSurface(slot);
  bool isOutline =
      differsFrom(here, pixel.x - 1u, pixel.y) || differsFrom(here, pixel.x + 1u, pixel.y) ||
      differsFrom(here, pixel.x, pixel.y - 1u) || differsFrom(here, pixel.x, pixel.y + 1u);
  gCache.outlines.data[slot] = isOutline ? 1u : 0u;
}
