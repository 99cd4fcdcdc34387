// atrous, last pass: multiplies by the reflectance.
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/atrous/read.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide guide = guideRead(gBuffers.guide, slot);
  gBuffers.shown.data[slot] = atrousRead(slot, gParams.iterations).light * guide.reflectance;
}
