// The pixel cache: one slot a pixel. Donor over time: the pixel that the surface was seen in last
// frame; over space: the pixel that a frame's random pairing gives.
RL_FN uint cacheSlot(RL_IN(uvec2) pixel) { return pixel.y * gFrame.width + pixel.x; }

RL_FN uvec2 cachePixel(uint slot) { return uvec2(slot % gFrame.width, slot / gFrame.width); }

RL_FN VisibleSurface cacheSurface(uint slot) {
  return visibleRead(gCache.visible, gFrame.camera, slot);
}
RL_FN VisibleSurface cacheSurfaceBefore(uint slot) {
  return visibleRead(gCache.visibleBefore, gFrame.previousCamera, slot);
}

RL_FN bool cacheIsOutline(uint slot) { return gCache.outlines.data[slot] != 0u; }

// Two surfaces are alike enough to exchange samples. Symmetric.
RL_FN bool cacheSurfacesMatch(RL_IN(VisibleSurface) a, RL_IN(VisibleSurface) b) {
  if (a.isHit == 0u || b.isHit == 0u) return false;
  vec3 camera = gFrame.camera.posW;
  float distanceToCamera = max(distance(camera, a.posW), distance(camera, b.posW));
  return visibleMatch(a, b, distanceToCamera, gCacheParams.minNormalDot,
                      gCacheParams.maxPlaneDistance);
}

RL_FN bool cacheDonorOverTime(uint slot, RL_OUT(uint) donor) {
  donor = slot;
  if (gFrame.frame == 0u) return false;
  if (gFrame.stillFrames != 0u) return true;
  VisibleSurface here = cacheSurface(slot);
  vec2 film;
  if (!visibleFilmBefore(here, film)) return false;
  donor = uint(film.y) * gFrame.width + uint(film.x);
  return cacheSurfacesMatch(here, cacheSurfaceBefore(donor));
}

// Pairs for the exchange over space: the frame is cut into square tiles (gCacheParams.tile),
// randomly placed, and in each tile a pixel's partner is its mirror image about a random point,
// modulo the tile's side. So the partner of the partner is the pixel itself, and every offset
// within the tile is equally likely. `pairing` numbers independent pairings. False where the
// partner is the pixel itself or outside the image.
RL_FN bool cacheMirror(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  uint side = gCacheParams.tile;
  uint shift = rngSharedBits(pairing, RL_DIM_DONOR_U);
  uint shiftX = (shift & 0xffffu) % side;
  uint shiftY = (shift >> 16u) % side;
  uint tileX = (pixel.x + shiftX) / side;
  uint tileY = (pixel.y + shiftY) / side;
  uint centre =
      rngSharedBits(rngHash(rngHash(tileX + 0x9e3779b9u) ^ tileY) + pairing, RL_DIM_DONOR_V);
  uint localX = ((centre & 0xffffu) % side + side - (pixel.x + shiftX) % side) % side;
  uint localY = ((centre >> 16u) % side + side - (pixel.y + shiftY) % side) % side;
  // Left of the image is below zero, which wraps to above its width.
  partner = uvec2(tileX * side + localX - shiftX, tileY * side + localY - shiftY);
  return partner.x < gFrame.width && partner.y < gFrame.height &&
         (partner.x != pixel.x || partner.y != pixel.y);
}

RL_FN bool cacheMirrorMatches(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  if (!cacheMirror(pixel, pairing, partner)) return false;
  return cacheSurfacesMatch(cacheSurface(cacheSlot(pixel)), cacheSurface(cacheSlot(partner)));
}

// Two pairings are tried; the second pairs only those whom the first has left alone.
RL_FN bool cachePartner(RL_IN(uvec2) pixel, uint k, RL_OUT(uint) slot) {
  slot = RL_INVALID;
  uvec2 partner;
  if (!cacheMirrorMatches(pixel, 2u * k, partner)) {
    if (!cacheMirrorMatches(pixel, 2u * k + 1u, partner)) return false;
    uvec2 first;
    if (cacheMirrorMatches(partner, 2u * k, first)) return false;
  }
  slot = cacheSlot(partner);
  return true;
}
