// The pixel cache: one slot a pixel. Donor over time: the pixel that the surface was seen in last
// frame; over space: the pixel that a frame's random pairing gives.

RL_FN uint cacheSlot(RL_IN(uvec2) pixel) { return pixel.y * gFrame.width + pixel.x; }

RL_FN bool cacheSlotOfFilm(RL_IN(vec2) film, RL_OUT(uint) slot) {
  slot = 0u;
  if (!(film.x >= 0.0f && film.y >= 0.0f && film.x < float(gFrame.width) &&
        film.y < float(gFrame.height))) {
    return false;
  }
  slot =
      min(uint(film.y), gFrame.height - 1u) * gFrame.width + min(uint(film.x), gFrame.width - 1u);
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

// Pairs for the exchange over space: the frame is cut into tiles of spatialTile pixels, randomly
// placed, and in each tile a pixel's partner is its mirror image about a random point, modulo the
// tile's side. So the partner of the partner is the pixel itself, and every offset within the tile
// is equally likely. `pairing` numbers independent pairings. False where the partner is the pixel
// itself or outside the image.
RL_FN bool cacheMirror(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  uint side = gParams.spatialTile;
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

RL_FN bool cacheMirrorMatches(RL_IN(uvec2) pixel, RL_IN(Anchor) here, uint pairing,
                              RL_OUT(uvec2) partner) {
  if (!cacheMirror(pixel, pairing, partner)) return false;
  Anchor there = cacheAnchorNow(cacheSlot(partner));
  vec3 camera = gFrame.camera.posW;
  return cacheAnchorsMatch(here, there,
                           max(distance(camera, here.posW), distance(camera, there.posW)));
}

// My k-th donor over space, whose k-th donor I am. Two pairings are tried; the second pairs only
// those whom the first has left alone.
RL_FN bool cachePartner(RL_IN(uvec2) pixel, RL_IN(Anchor) here, uint k, RL_OUT(uint) slot) {
  slot = RL_INVALID;
  uvec2 partner;
  if (!cacheMirrorMatches(pixel, here, 2u * k, partner)) {
    if (!cacheMirrorMatches(pixel, here, 2u * k + 1u, partner)) return false;
    Anchor there = cacheAnchorNow(cacheSlot(partner));
    uvec2 first;
    if (cacheMirrorMatches(partner, there, 2u * k, first)) return false;
  }
  slot = cacheSlot(partner);
  return true;
}
