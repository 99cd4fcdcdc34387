// Temporal pass, in frames of a new view: merges the last frame's reservoir of the pixel's surface
// into this frame's. (In a still view the initial pass merges both, without a ray.)

RL_FN GBufferTexel gbufferPrevious(uint pixelIndex) {
  return gbufferRead(gBuffers.gbufferPrevious, gFrame.previousCamera, pixelIndex);
}

#include "core/resampling/reproject.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/temporal_shift.glsl"
#include "core/reuse/temporal_merge.glsl"
#include "core/reuse/history_kept.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  if (gParams.reuse.temporalReuse == 0u || gParams.reuse.reproject == 0u) return;
  uint previousPixel =
      reprojectedPixelIndex(gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex));
  if (previousPixel == RL_INVALID) return;
  // Share kept, as found at the donor's pixel.
  float kept = historyKept(previousPixel);
  if (!(kept > 0.0f)) return;
  RL_RESERVOIR here = reservoirReadNow(pixelIndex);
  if (temporalMerge(pixelIndex, previousPixel, kept, here)) {
    reservoirWriteNow(pixelIndex, here);
  } else {
    stateWriteNow(pixelIndex, here);
  }
}
