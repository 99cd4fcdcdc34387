// Spatial donors: the pixels of a frame in random pairs, so that each shift serves the merges of
// both. A pixel's neighbours depend only on the surfaces at pixel centres and on the number of the
// frame and of the round: a choice that depended on samples would be biased. The includer has
// gBuffers.gbuffer and gParams.pairs.

RL_FN GBufferTexel pairSurface(uint pixelIndex) {
  return gbufferRead(gBuffers.gbuffer, gFrame.camera, pixelIndex);
}

// Finds a pixel's neighbour. The frame is cut into square tiles (gParams.pairs.tile), randomly
// placed, and in each tile a pixel's neighbour is its mirror image about a random point, modulo the
// tile's side. The neighbour of the neighbour is therefore the pixel itself, and every offset
// within the tile is equally likely. `pairing` numbers independent pairings. Returns false if the
// neighbour is the pixel itself or outside the image.
RL_FN bool partnerMirror(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) neighbour) {
  uint side = gParams.pairs.tile;
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
  neighbour = uvec2(tileX * side + localX - shiftX, tileY * side + localY - shiftY);
  return neighbour.x < gFrame.width && neighbour.y < gFrame.height &&
         (neighbour.x != pixel.x || neighbour.y != pixel.y);
}

RL_FN bool partnerMirrorMatches(RL_IN(uvec2) pixel, uint pairing, RL_OUT(uvec2) neighbour) {
  if (!partnerMirror(pixel, pairing, neighbour)) return false;
  return gbufferIsSimilar(pairSurface(pixelIndexOf(pixel)), pairSurface(pixelIndexOf(neighbour)),
                          gParams.pairs.similarity);
}

// Finds the pixel index of a pixel's k-th neighbour, whose own k-th neighbour is the pixel; false
// if there is none. Two pairings are tried; the second pairs only pixels that the first has left
// alone.
RL_FN bool pairFind(RL_IN(uvec2) pixel, uint k, RL_OUT(uint) pixelIndex) {
  pixelIndex = RL_INVALID;
  uvec2 neighbour;
  if (!partnerMirrorMatches(pixel, 2u * k, neighbour)) {
    if (!partnerMirrorMatches(pixel, 2u * k + 1u, neighbour)) return false;
    uvec2 first;
    if (partnerMirrorMatches(neighbour, 2u * k, first)) return false;
  }
  pixelIndex = pixelIndexOf(neighbour);
  return true;
}
