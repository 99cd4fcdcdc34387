// restir_gi, spatial pass: merges partners' reservoirs, shades, and leaves the history. It traces
// no ray: the shifts between partners were made by the temporal pass.
#include "core/resampling/ris.glsl"
#include "core/resampling/mis.glsl"
#include "core/resampling/shift.glsl"
#include "core/payload/path_sample.glsl"
#include "core/resampling/merge.glsl"
#include "core/resampling/reuse.glsl"
#include "core/caches/pixel.glsl"
#include "integrators/restir_gi/store.glsl"
#include "integrators/restir_gi/donors.glsl"

// Merges the partners' reservoirs into the slot's; returns what the pixel shows of it.
RL_FN vec3 giReuseOverSpace(uint slot, RL_INOUT(PathReservoir) r) {
  uint flags = gParams.spatialFlags;
  Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
  rng.vertex = RL_VERTEX_SPATIAL;
  real share = reuseDonorShare(giAge(slot), gParams.donorNoise);
  giReadNow(slot, r);
  ReservoirState donor = r.state;
  real cDonors = 0.0f;
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[giExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    giReadStateNow(partner, donor);
    cDonors += share * donor.confidence;
  }
  MergeState merge = mergeBegin(r.state, cDonors);
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[giExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    giReadStateNow(partner, donor);
    mergeWeighCanonical(merge, r.state, share * donor.confidence,
                        giReadShifted(giExchangeIndex(slot, k)), flags);
  }
  mergeCanonical(merge, r.state, flags);
  ReservoirState selected = r.state;
  uint winner = slot;
  float jacobian = 1.0f;
  for (uint k = 0u; k < gParams.spatialNeighbours; k = k + 1u) {
    uint partner = gBuffers.partners.data[giExchangeIndex(slot, k)];
    if (partner == RL_INVALID) continue;
    giReadStateNow(partner, donor);
    Shifted theirs = giReadShifted(giExchangeIndex(partner, k));
    vec3 ratio = giRatio(cacheSurface(partner), slot);
    float u = rngDraw(rng, RL_DIM_RIS_MERGE + k);
    if (mergeDonor(merge, selected, donor, share * donor.confidence, theirs, ratio, flags, u)) {
      winner = partner;
      jacobian = theirs.jacobian;
    }
  }
  mergeEnd(merge, selected, flags);
  if (winner != slot) giReadNow(winner, r);
  r.path.geometry *= jacobian;
  r.state = selected;
  return merge.estimate;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  PathReservoir r;
  r.path.suffix = pathNoSuffix();
  vec3 radiance = recordVec3(RL_PAST_QUAD(gBuffers.own, slot));
  radiance += giReuseOverSpace(slot, r);
  if (!rlIsFinite3(radiance)) {
    // A poisoned history would spread: it starts again from nothing here.
    RL_HEALTH(RL_HEALTH_NONFINITE);
    radiance = vec3(0.0f, 0.0f, 0.0f);
    r.state = giEmptyState();
  }
  giWriteHistory(slot, r);
  if (min(radiance.x, min(radiance.y, radiance.z)) < 0.0f) RL_HEALTH(RL_HEALTH_NEGATIVE);
  gBuffers.radiance.data[slot] = radiance;
}
