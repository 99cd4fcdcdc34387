// spatial_shift, a pass: every pixel shifts its sample to its spatial neighbours.
// Neighbours are mutual, so that each shift serves the merges of both.
#include "core/resampling/pairs.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/spatial_neighbours.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  RL_RESERVOIR r = reservoirReadNow(pixelIndex);
  uint donors = spatialDonors();
  for (uint k = 0u; k < donors; k = k + 1u) {
    uint neighbour;
    bool exists = spatialNeighbour(pixel, k, neighbour);
    if (exists) exists = mayExchange(pixelIndex, neighbour);
    RL_SHIFT shift = shiftNone();
    if (exists) shift = shiftTo(r, pixelOfIndex(neighbour), false, false);
    shiftTrace(shift, r);
    shiftedWrite(pairedShifts(k), pixelIndex, shift.shifted, exists ? neighbour : RL_INVALID);
  }
}
