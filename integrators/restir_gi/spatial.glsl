// restir_gi, spatial pass: merges partners' reservoirs, shades, and leaves the history. No ray is
// traced: the exchange pass has made the shifts.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/payload/path_sample.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/resampling/partners.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/ratio.glsl"
#include "integrators/restir_gi/donors.glsl"

#define RL_REUSE_STATE GiOverSpace

RL_FN Shifted giExchanged(uint slot, uint k, RL_OUT(uint) partner) {
  return shiftedRead(gBuffers.exchange, giExchangeIndex(slot, k), partner);
}
RL_FN uint giPartner(uint slot, uint k) {
  uint partner;
  giExchanged(slot, k, partner);
  return partner;
}
RL_FN Shifted reuseOurs(RL_IN(GiOverSpace) s, uint k) {
  uint partner;
  return giExchanged(s.slot, k, partner);
}
RL_FN Shifted reuseTheirs(RL_IN(GiOverSpace) s, uint k) {
  uint slot;
  return giExchanged(giPartner(s.slot, k), k, slot);
}
RL_FN bool reuseDonor(RL_IN(GiOverSpace) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  uint partner = giPartner(s.slot, k);
  if (partner == RL_INVALID) return false;
  donor = giReadStateNow(partner);
  donor.confidence *= s.share;
  return true;
}
RL_FN real3 reuseRatio(RL_IN(GiOverSpace) s, uint k) {
  return giRatio(partnerSurface(giPartner(s.slot, k)), s.slot);
}
RL_FN real reuseUniform(RL_IN(GiOverSpace) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/reuse.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  GiOverSpace s;
  s.slot = slotOfPixel(pixel);
  s.share = reuseDonorShare(giAge(), gParams.donorNoise);
  s.rng = rngInit(gFrame.seed, s.slot, gFrame.frame);
  s.rng.vertex = RL_VERTEX_SPATIAL;
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(s.slot, r);
  uint winner;
  float jacobian;
  vec3 radiance = recordVec3(RL_PAST_QUAD(gBuffers.own, s.slot));
  radiance += reuseMerge(s, giDonors(), gParams.spatialFlags, r.state, winner, jacobian);
  if (winner != RL_INVALID) giTakePathNow(giPartner(s.slot, winner), r);
  r.path.geometry *= jacobian;
  if (!rlIsFinite3(radiance)) {
    // A NaN or Inf would spread by reuse. Reset the reservoir and count it.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  giWriteHistory(s.slot, r);
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[s.slot] = radiance;
}
