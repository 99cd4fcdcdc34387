// atrous, first pass: divides the radiance by the reflectance.
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide guide = guideRead(gBuffers.guide, slot);
  filterWrite(gBuffers.even, slot, filterBegin(gBuffers.radiance.data[slot], guide));
}
