// atrous, last pass: multiplies by the reflectance.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/atrous/read.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Guide guide = guideRead(gBuffers.guide, pixelIndex);
  gBuffers.shown.data[pixelIndex] =
      atrousRead(pixelIndex, gParams.iterations).light * guide.reflectance;
}
