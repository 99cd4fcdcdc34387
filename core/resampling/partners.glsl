// Donors over space: the pixels of a frame in random pairs, so that each shift serves the merges of
// both. A pixel's partners depend on what pixels show at their centres and on the frame's number
// alone: a choice that knew samples would bias what it lets through. The includer has
// gBuffers.visible and gParams.partners.

RL_FN VisibleSurface partnerSurface(uint slot) {
  return visibleRead(gBuffers.visible, gFrame.camera, slot);
}

// The frame is cut into square tiles (gParams.partners.tile), randomly placed, and in each tile a
// pixel's partner is its mirror image about a random point, modulo the tile's side. So the partner
// of the partner is the pixel itself, and every offset within the tile is equally likely. `pairing`
// numbers independent pairings. False where the partner is the pixel itself or outside the image.
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
  // Left of the image is below zero, which wraps to above its width.
  partner = uvec2(tileX * side + localX - shiftX, tileY * side + localY - shiftY);
  return partner.x < gFrame.width && partner.y < gFrame.height &&
         (partner.x != pixel.x || partner.y != pixel.y);
}

RL_FN bool partnerMirrorMatches(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) partner) {
  if (!partnerMirror(pixel, pairing, partner)) return false;
  return visibleAlike(partnerSurface(slotOfPixel(pixel)), partnerSurface(slotOfPixel(partner)),
                      gParams.partners.alike);
}

// The slot of a pixel's k-th partner, whose k-th partner it is; false where it has none. Two
// pairings are tried; the second pairs only those whom the first has left alone.
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
