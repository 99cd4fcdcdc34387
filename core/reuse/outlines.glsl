// Pass of new views: marks pixels that show the outline of a surface, judged by the centres of the
// four pixels beside them. Old histories do
// not exchange samples there (core/reuse/spatial_neighbours.glsl).
#include "core/resampling/pairs.glsl"

// Left of column 0 and above row 0 the index wraps to a large number, which is outside, too.
RL_FN bool differsFrom(RL_IN(GBufferTexel) here, uint x, uint y) {
  if (x >= gFrame.width || y >= gFrame.height) return false;
  return !gbufferIsSimilar(here, pairSurface(pixelIndexOf(uvec2(x, y))), gParams.pairs.similarity);
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  GBufferTexel here = pairSurface(pixelIndex);
  bool isOutline =
      differsFrom(here, pixel.x - 1u, pixel.y) || differsFrom(here, pixel.x + 1u, pixel.y) ||
      differsFrom(here, pixel.x, pixel.y - 1u) || differsFrom(here, pixel.x, pixel.y + 1u);
  gBuffers.outlines.data[pixelIndex] = isOutline ? 1u : 0u;
}
