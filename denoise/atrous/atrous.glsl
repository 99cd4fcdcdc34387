// atrous: one iteration.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/atrous/read.glsl"

RL_FN Filtered waveletRead(uint pixelIndex) { return atrousRead(pixelIndex, gParams.step); }

#include "denoise/common/wavelet.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  Filtered filtered = waveletStep(pixel);
  if ((gParams.step & 1u) == 0u) {
    filterWrite(gBuffers.odd, pixelIndexOf(pixel), filtered);
  } else {
    filterWrite(gBuffers.even, pixelIndexOf(pixel), filtered);
  }
}
