// Entries of caches in world space: anchors, and which pixels offer their sample in a frame. Pixels
// offer in groups of gParams.entries.feedEvery that lie side by side; each frame one of a group
// does, all of them in turn. An entry takes the samples of the groups with the greatest tickets,
// which do not depend on who comes first.

RL_FN Anchor anchorNone() {
  Anchor a;
  a.surface.posW = vec3(0.0f, 0.0f, 0.0f);
  a.surface.isHit = 0u;
  a.surface.emits = 0u;
  a.surface.nGeoW = 0u;
  a.surface.nShadeW = 0u;
  a.surface.reflectance = vec3(0.0f, 0.0f, 0.0f);
  a.posError = 0.0f;
  a.begunBy = RL_INVALID;
  return a;
}

RL_FN Anchor anchorRead(RL_IN(QuadRef) quads, uint entry) {
  uvec4 q0 = RL_PAST_QUAD(quads, entry * RL_ANCHOR_QUADS);
  uvec4 q1 = RL_PAST_QUAD(quads, entry * RL_ANCHOR_QUADS + 1u);
  Anchor a;
  a.surface.posW = recordVec3(q0);
  a.surface.isHit = q1.z >> 30u;
  a.surface.emits = 0u;
  a.surface.nGeoW = q0.w;
  a.surface.nShadeW = q1.x;
  a.surface.reflectance = unpackColor(q1.z);
  a.posError = uintBitsToFloat(q1.y);
  a.begunBy = q1.w;
  return a;
}

RL_FN void anchorWrite(RL_IN(QuadRef) quads, uint entry, RL_IN(Anchor) a) {
  RL_WRITE_QUAD(quads, entry * RL_ANCHOR_QUADS, recordQuad(a.surface.posW, a.surface.nGeoW));
  RL_WRITE_QUAD(quads, entry * RL_ANCHOR_QUADS + 1u,
                uvec4(a.surface.nShadeW, floatBitsToUint(a.posError),
                      packColor(a.surface.reflectance) | (a.surface.isHit << 30u), a.begunBy));
}

RL_FN uint entryGroup(uint slot) { return slot / gParams.entries.feedEvery; }
// The slot of a group that offers in this frame; that of the last group may lie outside the image.
RL_FN uint entryOfferer(uint group) {
  uint every = gParams.entries.feedEvery;
  return group * every + (rngHash(group) % every + gFrame.frame) % every;
}

// A number of its own for each group or pixel, in an order that changes from frame to frame; 0 for
// one of 2^32, which then waits a frame.
RL_FN uint entryTicket(uint index) {
  return (index + rngSharedBits(0u, RL_DIM_DONOR_U)) * 2654435761u;
}
RL_FN uint entryOfTicket(uint ticket) {
  return ticket * 244002641u - rngSharedBits(0u, RL_DIM_DONOR_U);
}
