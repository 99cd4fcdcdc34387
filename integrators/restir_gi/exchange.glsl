// restir_gi, exchange pass: every pixel shifts its sample to its spatial partners. Partners are
// mutual, so that each shift serves the merges of both.
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "core/payload/path_shift.glsl"
#include "core/resampling/partners.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/donors.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = slotOfPixel(pixel);
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(slot, r);
  uint donors = giDonors();
  for (uint k = 0u; k < donors; k = k + 1u) {
    uint index = giExchangeIndex(slot, k);
    uint partner;
    bool exists = partnerFind(pixel, k, partner);
    if (exists) exists = giMayServe(slot, partner);
    PathShift shift = pathShiftNone();
    if (exists) shift = pathShiftTo(r, pixelOfSlot(partner), false, false);
    pathShiftTrace(shift, r.path);
    shiftedWrite(gBuffers.exchange, index, shift.shifted, exists ? partner : RL_INVALID);
  }
}
