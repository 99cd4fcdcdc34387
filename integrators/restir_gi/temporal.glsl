// restir_gi, temporal pass: merges the last frame's reservoir of the same surface into the new one,
// then shifts the result to the pixel's partners of the spatial pass, each shift once for both
// merges of a pair. Round 0 is that of time, each further one that of a partner: a round makes its
// shifts, traces their shadow rays by the one call of the kernel, and uses them.
#include "integrators/restir_gi/merge.glsl"
#define RL_RESERVOIR LightReservoir
#include "integrators/restir_gi/over_time.glsl"
#undef RL_RESERVOIR
#define RL_RESERVOIR PathReservoir
#include "integrators/restir_gi/over_time.glsl"
#undef RL_RESERVOIR

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint slot = cacheSlot(pixel);
  Anchor here = cacheAnchorNow(slot);
  if (here.isReusable == 0u) return;
  LightReservoir light;
  PathReservoir path;
  // Kept from round to round: what this pass has written it may not read. One that is not wanted is
  // read too and not used.
  cacheReadNow(slot, light);
  cacheReadNow(slot, path);
  ReservoirState nothing;
  nothing.F = vec3(0.0f, 0.0f, 0.0f);
  nothing.W = 0.0f;
  nothing.residual = nothing.F;
  nothing.confidence = 0.0f;
  Ray noRay;
  noRay.origin = here.posW;
  noRay.tMin = 0.0f;
  noRay.dir = here.nGeoW;
  noRay.tMax = 0.0f;
  for (uint round = 0u; round <= gParams.spatialNeighbours; round = round + 1u) {
    GiSegments segments;
    for (uint i = 0u; i < RL_GI_SEGMENTS; i = i + 1u) {
      segments.rays[i] = noRay;
      segments.asks[i] = 0u;
      segments.visibility[i] = 1.0f;
    }
    Anchor there = here;
    uint other = RL_INVALID;  // the slot that is exchanged with
    bool hasOther = false;
    LightReservoir lightDonor = light;
    PathReservoir pathDonor = path;
    Shifted lightOurs = mergeUnshifted(nothing);
    Shifted lightTheirs = lightOurs;
    Shifted pathOurs = lightOurs;
    Shifted pathTheirs = lightOurs;
    bool lightMerges = giWantsDirect();
    bool pathMerges = giWantsIndirect();
    if (round == 0u) {
      hasOther = gParams.temporalReuse != 0u && cacheDonorOverTime(here, other);
      if (hasOther) {
        there = cacheAnchorBefore(other);
        hasOther = cacheAnchorsMatch(here, there, distance(gFrame.camera.posW, here.posW));
      }
      if (hasOther && lightMerges) {
        lightMerges = giShiftOverTime(slot, here, other, there, 0u, light, lightDonor, lightOurs,
                                      lightTheirs, segments);
      }
      if (hasOther && pathMerges) {
        pathMerges = giShiftOverTime(slot, here, other, there, 2u, path, pathDonor, pathOurs,
                                     pathTheirs, segments);
      }
    } else {
      hasOther = cachePartner(pixel, here, round - 1u, other);
      if (hasOther) there = cacheAnchorNow(other);
      if (hasOther && lightMerges) lightOurs = giShift(light, here, there, false, 0u, segments);
      if (hasOther && pathMerges) pathOurs = giShift(path, here, there, false, 2u, segments);
    }
    for (uint i = 0u; i < RL_GI_SEGMENTS; i = i + 1u) {
      if (segments.asks[i] == 0u) continue;
      Hit hit;
      segments.visibility[i] = traceRay(segments.rays[i], RL_RAY_SHADOW, 0u, hit);
    }
    if (round == 0u) {
      Rng rng = rngInit(gFrame.seed, slot, gFrame.frame);
      rng.vertex = RL_VERTEX_TEMPORAL;
      float uLight = rngDraw(rng, RL_DIM_RIS_MERGE_DI);
      float uPath = rngDraw(rng, RL_DIM_RIS_MERGE_GI);
      if (hasOther && lightMerges) {
        lightOurs.F *= segments.visibility[0];
        lightTheirs.F *= segments.visibility[1];
        giMergeOverTime(slot, here, there, uLight, lightOurs, lightTheirs, light, lightDonor);
      }
      if (hasOther && pathMerges) {
        pathOurs.F *= segments.visibility[2];
        pathTheirs.F *= segments.visibility[3];
        giMergeOverTime(slot, here, there, uPath, pathOurs, pathTheirs, path, pathDonor);
      }
    } else {
      uint index = cacheExchangeIndex(slot, round - 1u);
      if (hasOther && lightMerges) {
        lightOurs.F *= segments.visibility[0];
        cacheWriteShifted(index, light, lightOurs);
      }
      if (hasOther && pathMerges) {
        pathOurs.F *= segments.visibility[2];
        cacheWriteShifted(index, path, pathOurs);
      }
      gBuffers.partners.data[index] = other;
    }
  }
}
