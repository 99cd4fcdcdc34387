// Spatial donors: the pixels of a frame in random pairs, so that each shift serves the merges of
// both. A pixel's partners depend only on the surfaces at pixel centres and on the frame's number:
// a choice that depended on samples would be biased. The includer has gBuffers.visible and
// gParams.partners.

RL_FN VisibleSurface partnerSurface(uint slot) {
  return visibleRead(gBuffers.visible, gFrame.camera, slot);
}

// Finds a pixel's partner. The frame is cut into square tiles (gParams.partners.tile), randomly
// placed, and in each tile a pixel's partner is its mirror image about a random point, modulo the
// tile's side. The partner of the partner is therefore the pixel itself, and every offset within
// the tile is equally likely. `pairing` numbers independent pairings. Returns false if the partner
// is the pixel itself or outside the image.
RL_FN bool partnerMirror(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  uint side = gParams.partners.tile;
  uint shift = rngSharedBits(pairing, RL_DIM_DONOR_U);
  uint shiftX = (shift & 0xffffu) % side;
  uint shiftY = (shift >> 16u) % side;
  uint tileX = (pixel.x + shiftX) / side;
  uint tileY = (pixel.y + shiftY) / side;
  uint centre =
      rngSharedBits(rngHash(rngHash(tileX + 0x9e3779b9u) ^ tileY) + pairing, RL_DIM_DONOR_V);
  uint localX = ((centre & 0xffffu) % side + side - (pixel.x + shiftX) % side) % side;
  uint localY = ((centre >> 16u) % side + side - (pixel.y + shiftY) % side) % side;
  // Coordinates left of the image or above wrap to large numbers.
  partner = uvec2(tileX * side + localX - shiftX, tileY * side + localY - shiftY);
  return partner.x < gFrame.width && partner.y < gFrame.height &&
         (partner.x != pixel.x || partner.y != pixel.y);
}

RL_FN bool partnerMirrorMatches(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  if (!partnerMirror(pixel, pairing, partner)) return false;
  return visibleAlike(partnerSurface(slotOfPixel(pixel)), partnerSurface(slotOfPixel(partner)),
                      gParams.partners.alike);
}

// Finds the slot of a pixel's k-th partner, whose own k-th partner is the pixel; false if there is
// none. Two pairings are tried; the second pairs only pixels that the first has left alone.
RL_FN bool partnerFind(RL_IN(uvec2) pixel, uint k, RL_OUT(uint) slot) {
  slot = RL_INVALID;
  uvec2 partner;
  if (!partnerMirrorMatches(pixel, 2u * k, partner)) {
    if (!partnerMirrorMatches(pixel, 2u * k + 1u, partner)) return false;
    uvec2 first;
    if (partnerMirrorMatches(partner, 2u * k, first)) return false;
  }
  slot = slotOfPixel(partner);
  return true;
}
