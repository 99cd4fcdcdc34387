// Shift over time in frames of a new view: two rays each way.
#include "core/reuse/reflectance_ratio.glsl"

RL_FN bool temporalIsStill() { return false; }

// Shifts the pixel's own sample to the donor's pixel in the last frame, then the donor's sample to
// this pixel.
RL_FN void temporalShift(RL_INOUT(TemporalMerge) t, RL_IN(RL_RESERVOIR) here,
                         RL_IN(RL_RESERVOIR) donor, uint pixelIndex, uint before) {
  uint flags = gParams.reuse.temporalFlags;
  t.ratio = pixelReflectanceRatio(
      visibleRead(gBuffers.visibleBefore, gFrame.previousCamera, before), pixelIndex);
  RL_SHIFT shift =
      shiftTo(here, pixelOfIndex(before), true, (flags & RL_REUSE_ASSUME_VISIBLE) != 0u);
  RL_RESERVOIR moved = here;
  t.canonicalAtNeighbour = shift.shifted;
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
