// Temporal pass, in frames of a new view: merges the last frame's reservoir of the pixel's surface
// into this frame's. (In a still view the initial pass merges both, without a ray.)

RL_FN GBufferTexel visibleBefore(uint pixelIndex) {
  return visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, pixelIndex);
}

#include "core/resampling/reproject.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/temporal_shift.glsl"
#include "core/reuse/temporal_merge.glsl"
#include "core/reuse/history_weight.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  if (gParams.reuse.temporalReuse == 0u || gParams.reuse.reproject == 0u) return;
  uint before = reprojectedPixelIndex(visibleRead(gBuffers.visible, gFrame.camera, pixelIndex));
  if (before == RL_INVALID) return;
  // Share kept, as found at the donor's pixel.
  float kept = historyWeight(before);
  if (!(kept > 0.0f)) return;
  RL_RESERVOIR here = sampleNone();
  reservoirReadNow(pixelIndex, here);
  if (temporalMerge(pixelIndex, before, kept, here)) {
    reservoirWriteNow(pixelIndex, here);
  } else {
    stateWriteNow(pixelIndex, here);
  }
}
