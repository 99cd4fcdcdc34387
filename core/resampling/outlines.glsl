// A pass of new views: which pixels show the outline of a surface, as far as the centres of the
// four pixels beside them tell. Two pixels there may differ in every sample. The integrator adds it
// as a kernel of its own; it has gBuffers.outlines beside what partners take.
#include "core/resampling/partners.glsl"

// Left of column 0 and above row 0 the number wraps to the largest there is, which is outside, too.
RL_FN bool differsFrom(RL_IN(VisibleSurface) here, uint x, uint y) {
  if (x >= gFrame.width || y >= gFrame.height) return false;
  return !visibleAlike(here, partnerSurface(slotOfPixel(uvec2(x, y))), gParams.partners.alike);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  VisibleSurface here = partnerSurface(slot);
  bool isOutline =
      differsFrom(here, pixel.x - 1u, pixel.y) || differsFrom(here, pixel.x + 1u, pixel.y) ||
      differsFrom(here, pixel.x, pixel.y - 1u) || differsFrom(here, pixel.x, pixel.y + 1u);
  gBuffers.outlines.data[slot] = isOutline ? 1u : 0u;
}
