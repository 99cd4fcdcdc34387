// The pixel cache: one slot a pixel. Donor over time: the pixel that the surface was seen in last frame;
// over space: a random pixel of a disk.

RL_FN uint cacheSlot(RL_IN(uvec2) pixel) { return pixel.y * gFrame.width + pixel.x; }

RL_FN bool cacheSlotOfFilm(RL_IN(vec2) film, RL_OUT(uint) slot) {
  slot = 0u;
  if (!(film.x >= 0.0f && film.y >= 0.0f && film.x < float(gFrame.width) && film.y < float(gFrame.height))) {
    return false;
  }
  slot = min(uint(film.y), gFrame.height - 1u) * gFrame.width + min(uint(film.x), gFrame.width - 1u);
  return true;
}

RL_FN bool cacheDonorOverTime(RL_IN(Anchor) here, RL_OUT(uint) slot) {
  vec2 film;
  slot = 0u;
  vec2 resolution = vec2(float(gFrame.width), float(gFrame.height));
  if (gFrame.frame == 0u) return false;
  if (!cameraProject(gFrame.previousCamera, here.posW, resolution, film)) return false;
  return cacheSlotOfFilm(film, slot);
}

// `attempt` numbers the draws: neighbours and retries have their own dimensions.
RL_FN bool cacheDonorOverSpace(RL_IN(uvec2) pixel, RL_IN(Rng) rng, uint attempt, RL_OUT(uint) slot) {
  Rng r = rng;
  r.vertex = RL_VERTEX_SPATIAL + 1u + attempt;
  float u = rngDraw(r, RL_DIM_DONOR_U);
  float v = rngDraw(r, RL_DIM_DONOR_V);
  float radius = gParams.spatialRadius * sqrt(u);
  vec2 cs = rlCosSin2Pi(v);
  vec2 film = vec2(float(pixel.x) + 0.5f + radius * cs.x, float(pixel.y) + 0.5f + radius * cs.y);
  if (!cacheSlotOfFilm(film, slot)) return false;
  return slot != cacheSlot(pixel);
}
