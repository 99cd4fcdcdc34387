// Shift over time in frames of a new view: each way up to two rays, to x1 and along the segment
// that reconnects, and those of a replayed prefix. The biased mode leaves out the segment.
#include "core/reuse/reflectance_ratio.glsl"

RL_FN bool temporalIsStill() { return false; }

// Shifts the pixel's own sample to the donor's pixel in the last frame, then the donor's sample to
// this pixel.
RL_FN void temporalShift(RL_INOUT(TemporalMerge) t, RL_IN(RL_RESERVOIR) here,
                         RL_IN(RL_RESERVOIR) donor, uint pixelIndex, uint previousPixel) {
  uint flags = gParams.reuse.temporalFlags;
  t.ratio = pixelReflectanceRatio(
      gbufferRead(gBuffers.gbufferPrevious, gFrame.previousCamera, previousPixel), pixelIndex);
  RL_SHIFT shift =
      shiftTo(here, pixelOfIndex(previousPixel), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
  RL_RESERVOIR moved = here;
  t.canonicalAtNeighbour = shift.shifted;  // set in the loop; compilers do not see that
  // A loop, so that the kernel has one call of shiftTrace().
  for (uint i = 0u; i < 2u; i = i + 1u) {
    if (i == 1u) {
      t.canonicalAtNeighbour = shift.shifted;
      shift = shiftTo(donor, pixelOfIndex(pixelIndex), false,
                      (flags & RL_REUSE_ASSUME_VISIBLE_HERE) != 0u);
      moved = donor;
    }
    shiftTrace(shift, moved);
  }
  t.neighbourAtCanonical = shift.shifted;
}
