// svgf, last pass: times reflectance.
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Guide guide = guideRead(gBuffers.guide, slot);
  gBuffers.shown.data[slot] = svgfRead(slot, gParams.iterations).light * guide.reflectance;
}
