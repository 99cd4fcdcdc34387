// svgf: one iteration of the wavelet transform.
#include "core/kernels/guide_data.glsl"
#include "denoise/common/filter.glsl"
#include "denoise/svgf/store.glsl"

RL_FN Filtered waveletRead(uint slot) { return svgfRead(slot, gParams.step); }

#include "denoise/common/wavelet.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  Filtered filtered = waveletStep(pixel);
  if ((gParams.step & 1u) == 0u) {
    filterWrite(gBuffers.odd, slot, filtered);
  } else {
    filterWrite(gBuffers.even, slot, filtered);
  }
  if (gParams.step == 0u && svgfHas(RL_SVGF_FEEDBACK)) {
    float frames = svgfHistoryRead(gBuffers.history, slot).frames;
    svgfHistoryWriteLight(gBuffers.history, slot, filtered.light, frames);
  }
}
