// Pass of new views: selects the entries that serve a pixel as donors. The first is the pixel's own
// entry, the others are entries of points beside it on its tangent plane. If no entry serves, the
// next coarser and finer levels are tried: the camera may have come nearer. The includer defines
// entryLevel(), entryNear() and entrySpread(), in metres.

// Returns whether an entry has a shading point similar to the surface that the pixel shows.
RL_FN bool entryServes(RL_IN(GBufferTexel) here, uint entry) {
  return gbufferIsSimilar(here, shadingPointRead(gBuffers.shadingPoints, entry).surface,
                          gParams.similarity);
}
// Entry that covers a point, if it serves the pixel; else RL_INVALID.
RL_FN uint entryServing(RL_IN(GBufferTexel) here, RL_IN(vec3) posW, uint level) {
  uint entry = entryNear(here, posW, level);
  return entry != RL_INVALID && entryServes(here, entry) ? entry : RL_INVALID;
}

RL_FN void kernelMain(RL_IN(uvec2) pixel) {
  uint pixelIndex = pixelIndexOf(pixel);
  GBufferTexel here = entryVisible(pixelIndex);
  if (here.isHit != 0u && gBuffers.entries.data[pixelIndex] == RL_INVALID)
    RL_HEALTH(RL_HEALTH_CACHE_FULL);
  uint level = entryLevel(here);
  uint first = pixelIndex * gParams.entries.proposals;
  Rng rng = rngInit(gFrame.seed ^ 0x3c6ef372u, pixelIndex, gFrame.frame);
  for (uint k = 0u; k < gParams.entries.proposals; k = k + 1u) {
    uint entry = RL_INVALID;
    if (here.isHit != 0u) {
      vec3 posW = here.posW;
      if (k > 0u) {
        rng.vertex = RL_VERTEX_SPATIAL + k;
        float u = rngDraw(rng, RL_DIM_DONOR_U);
        float v = rngDraw(rng, RL_DIM_DONOR_V);
        float radius = entrySpread(here) * sqrt(u);
        vec2 turn = rlCosSin2Pi(v);
        vec3 offset = vec3(radius * turn.x, radius * turn.y, 0.0f);
        posW += frameToWorld(unpackNormal(here.nGeoW), offset);
      }
      if (k > 0u) {
        entry = entryServing(here, posW, level);
      } else {
        entry = gBuffers.entries.data[pixelIndex];
        if (entry >= RL_GRID_CLAIM || !entryServes(here, entry)) entry = RL_INVALID;
      }
      if (entry == RL_INVALID) entry = entryServing(here, posW, level + 1u);
      if (entry == RL_INVALID) entry = entryServing(here, posW, level - 1u);
      for (uint i = 0u; i < k; i = i + 1u) {
        if (gBuffers.proposals.data[first + i] == entry) entry = RL_INVALID;
      }
    }
    gBuffers.proposals.data[first + k] = entry;
  }
}
