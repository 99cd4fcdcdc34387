// restir_gi, spatial_shift pass: every pixel shifts its sample to its spatial neighbours.
// Neighbours are mutual, so that each shift serves the merges of both.
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/path_sample/path_shift.glsl"
#include "core/resampling/pairs.glsl"
#include "integrators/restir_gi/reservoir_store.glsl"
#include "integrators/restir_gi/spatial_neighbours.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(pixelIndex, r);
  uint donors = giDonors();
  for (uint k = 0u; k < donors; k = k + 1u) {
    uint index = giPairedShiftIndex(pixelIndex, k);
    uint neighbour;
    bool exists = pairFind(pixel, k, neighbour);
    if (exists) exists = giMayServe(pixelIndex, neighbour);
    PathShift shift = pathShiftNone();
    if (exists) shift = pathShiftTo(r, pixelOfIndex(neighbour), false, false);
    pathShiftTrace(shift, r.path);
    shiftedWrite(gBuffers.pairedShifts, index, shift.shifted, exists ? neighbour : RL_INVALID);
  }
}
