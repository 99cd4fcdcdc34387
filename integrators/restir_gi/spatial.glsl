// restir_gi, spatial pass: merges neighbours' reservoirs, shades, and leaves the history. No ray is
// traced: the spatial_shift pass has made the shifts.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/resampling/reservoir.glsl"
#include "core/path_sample/path_sample.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/donors.glsl"
#include "core/resampling/pairs.glsl"
#include "integrators/restir_gi/reservoir_store.glsl"
#include "integrators/restir_gi/reflectance_ratio.glsl"
#include "integrators/restir_gi/spatial_neighbours.glsl"

#define RL_REUSE_STATE GiSpatialMerge

RL_FN Shifted giPairedShift(uint pixelIndex, uint k, RL_OUT(uint) neighbour) {
  return shiftedRead(gBuffers.pairedShifts, giPairedShiftIndex(pixelIndex, k), neighbour);
}
RL_FN uint giNeighbour(uint pixelIndex, uint k) {
  uint neighbour;
  giPairedShift(pixelIndex, k, neighbour);
  return neighbour;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(GiSpatialMerge) s, uint k) {
  uint neighbour;
  return giPairedShift(s.pixelIndex, k, neighbour);
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(GiSpatialMerge) s, uint k) {
  uint pixelIndex;
  return giPairedShift(giNeighbour(s.pixelIndex, k), k, pixelIndex);
}
RL_FN bool reuseDonor(RL_IN(GiSpatialMerge) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  uint neighbour = giNeighbour(s.pixelIndex, k);
  if (neighbour == RL_INVALID) return false;
  donor = giReadStateNow(neighbour);
  donor.confidence *= s.share;
  return true;
}
RL_FN real3 reuseRatio(RL_IN(GiSpatialMerge) s, uint k) {
  return giReflectanceRatio(pairSurface(giNeighbour(s.pixelIndex, k)), s.pixelIndex);
}
RL_FN real reuseUniform(RL_IN(GiSpatialMerge) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/reuse.glsl"

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  GiSpatialMerge s;
  s.pixelIndex = pixelIndexOf(pixel);
  s.share = reuseDonorShare(giAge(), gParams.donorNoise);
  s.rng = rngInit(gFrame.seed, s.pixelIndex, gFrame.frame);
  s.rng.vertex = RL_VERTEX_SPATIAL;
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  giReadNow(s.pixelIndex, r);
  uint winner;
  float jacobian;
  vec3 radiance = recordVec3(RL_PAST_QUAD(gBuffers.unresampled, s.pixelIndex));
  radiance += reuseMerge(s, giDonors(), gParams.spatialFlags, r.state, winner, jacobian);
  if (winner != RL_INVALID) giTakePathNow(giNeighbour(s.pixelIndex, winner), r);
  r.path.geometry *= jacobian;
  if (!rlIsFinite3(radiance)) {
    // A NaN or Inf would spread by reuse. Reset the reservoir and count it.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
  }
  giWriteHistory(s.pixelIndex, r);
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[s.pixelIndex] = radiance;
}
