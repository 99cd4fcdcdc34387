// Spatial pass: merges neighbours' reservoirs, shades, and leaves the history. The spatial_shift
// pass has made the shifts, so that no ray is traced here, but by a sample that RL_SAMPLE_SHADES
// shades. A round before the last only merges, and leaves the reservoirs of the next round in the
// history's place.
#include "core/resampling/pairs.glsl"
#include "core/reuse/reservoir_store.glsl"
#include "core/reuse/reflectance_ratio.glsl"
#include "core/reuse/spatial_neighbours.glsl"

#define RL_REUSE_STATE SpatialMerge

RL_FN Shifted pairedShift(uint pixelIndex, uint k, RL_OUT(uint) neighbour) {
  return shiftedRead(pairedShifts(k), pixelIndex, neighbour);
}
RL_FN uint pairedNeighbour(uint pixelIndex, uint k) {
  uint neighbour;
  pairedShift(pixelIndex, k, neighbour);
  return neighbour;
}
RL_FN Shifted reuseCanonicalAtNeighbour(RL_IN(SpatialMerge) s, uint k) {
  uint neighbour;
  return pairedShift(s.pixelIndex, k, neighbour);
}
RL_FN Shifted reuseNeighbourAtCanonical(RL_IN(SpatialMerge) s, uint k) {
  uint pixelIndex;
  return pairedShift(pairedNeighbour(s.pixelIndex, k), k, pixelIndex);
}
RL_FN bool reuseDonor(RL_IN(SpatialMerge) s, uint k, RL_OUT(ReservoirState) donor) {
  donor = reservoirEmpty();
  uint neighbour = pairedNeighbour(s.pixelIndex, k);
  if (neighbour == RL_INVALID) return false;
  donor = stateReadNow(neighbour);
  donor.confidence *= s.share;
  return true;
}
RL_FN real3 reuseRatio(RL_IN(SpatialMerge) s, uint k) {
  return pixelReflectanceRatio(pairSurface(pairedNeighbour(s.pixelIndex, k)), s.pixelIndex);
}
RL_FN real reuseUniform(RL_IN(SpatialMerge) s, uint k) {
  Rng rng = s.rng;
  return rngDraw(rng, RL_DIM_RIS_MERGE + k);
}

#include "core/resampling/merge_loop.glsl"

// Returns the merged reservoir; `estimate` is that of its integral.
RL_FN RL_RESERVOIR spatialMerge(uint pixelIndex, RL_OUT(vec3) estimate) {
  SpatialMerge s;
  s.pixelIndex = pixelIndex;
  s.share = reuseDonorShare(historyAge(), gParams.reuse.donorNoise);
  s.rng = rngInit(gFrame.seed, pixelIndex, gFrame.frame);
  s.rng.vertex = RL_VERTEX_SPATIAL + gParams.reuse.spatialRound;
  RL_RESERVOIR r = reservoirReadNow(pixelIndex);
  uint winner;
  float jacobian;
  estimate = reuseMerge(s, spatialDonors(), gParams.reuse.spatialFlags, r.state, winner, jacobian);
  if (winner != RL_INVALID) {
    takeSampleNow(pairedNeighbour(pixelIndex, winner), r);
    sampleAfterShift(r, jacobian);
  }
  return r;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  vec3 estimate;
  RL_RESERVOIR r = spatialMerge(pixelIndex, estimate);
  if (!isLastRound()) {
    reservoirGuard(r.state);
    reservoirWriteHistory(pixelIndex, r);
    return;
  }
#ifdef RL_SAMPLE_SHADES
  sampleShade(pixel, r, estimate);
#endif
  vec3 radiance = recordVec3(RL_EARLIER_UVEC4(gBuffers.unresampled, pixelIndex)) + estimate;
  RL_RESERVOIR next = r;
  if (gParams.reuse.spatialFeedback == 0u) next = reservoirReadNow(pixelIndex);
  if (!rlIsFinite3(radiance)) {
    // A NaN or Inf would spread by reuse. Reset the reservoir and count it.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    r.state = reservoirEmpty();
    next.state = r.state;
  }
  reservoirWriteHistory(pixelIndex, next);
  if (gParams.reuse.duplicationMap != 0u)
    gBuffers.sampleFilms.data[pixelIndex] = next.state.W > 0.0f ? sampleFilm(next) : 0u;
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[pixelIndex] = radiance;
  if (gParams.reuse.writesRadianceFrames != 0u)
    gBuffers.radianceFrames.data[pixelIndex] = radianceFrames(r.state.confidence);
}
