// atrous, first pass: divides the radiance by the reflectance.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  filterWrite(gBuffers.even, pixelIndex, filterBegin(gBuffers.radiance.data[pixelIndex], guide));
}
