// svgf: one iteration of the wavelet transform.
#include "core/gbuffer/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"

RL_FN Filtered waveletRead(uint pixelIndex) { return svgfRead(pixelIndex, gParams.step); }

#include "denoise/common/wavelet.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  Filtered filtered = waveletStep(pixel);
  if ((gParams.step & 1u) == 0u) {
    filterWrite(gBuffers.odd, pixelIndex, filtered);
  } else {
    filterWrite(gBuffers.even, pixelIndex, filtered);
  }
  if (gParams.step == 0u && svgfHas(RL_SVGF_FEEDBACK)) {
    float frames = svgfHistoryRead(gBuffers.history, pixelIndex).frames;
    svgfHistoryWriteLight(gBuffers.history, pixelIndex, filtered.light, frames);
  }
}
