// Layout of anchors (surface points that entries are valid at) in buffers.

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
