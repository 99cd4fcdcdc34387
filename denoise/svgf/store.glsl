// svgf: what passes and frames leave to each other.

RL_FN bool svgfHas(uint flag) { return (gParams.flags & flag) != 0u; }

RL_FN Filtered svgfRead(uint slot, uint step) {
  if ((step & 1u) == 0u) return filterRead(gBuffers.even, slot);
  return filterRead(gBuffers.odd, slot);
}

RL_FN SvgfHistory svgfNoHistory() {
  SvgfHistory h;
  h.light = vec3(0.0f, 0.0f, 0.0f);
  h.frames = 0.0f;
  h.mean = 0.0f;
  h.spread = 0.0f;
  h.step = 0.0f;
  h.last = 0.0f;
  return h;
}
RL_FN SvgfHistory svgfHistoryRead(RL_IN(QuadRef) quads, uint slot) {
  vec4 q0 = recordVec4(RL_PAST_QUAD(quads, slot * RL_SVGF_HISTORY_QUADS));
  vec4 q1 = recordVec4(RL_PAST_QUAD(quads, slot * RL_SVGF_HISTORY_QUADS + 1u));
  SvgfHistory h;
  h.light = vec3(q0.x, q0.y, q0.z);
  h.frames = q0.w;
  h.mean = q1.x;
  h.spread = q1.y;
  h.step = q1.z;
  h.last = q1.w;
  return h;
}
RL_FN void svgfHistoryWriteLight(RL_IN(QuadRef) quads, uint slot, RL_IN(vec3) light, float frames) {
  RL_WRITE_QUAD(quads, slot * RL_SVGF_HISTORY_QUADS, recordQuad(light, floatBitsToUint(frames)));
}
RL_FN void svgfHistoryWrite(RL_IN(QuadRef) quads, uint slot, RL_IN(SvgfHistory) h) {
  svgfHistoryWriteLight(quads, slot, h.light, h.frames);
  RL_WRITE_QUAD(quads, slot * RL_SVGF_HISTORY_QUADS + 1u,
                uvec4(floatBitsToUint(h.mean), floatBitsToUint(h.spread), floatBitsToUint(h.step),
                      floatBitsToUint(h.last)));
}

// Frames that the radiance of this frame averages itself, this one included.
RL_FN float svgfHeld(uint slot) {
  if (!svgfHas(RL_SVGF_CONFIDENCE)) return 1.0f;
  uint state = slot * RL_PATH_RESERVOIR_QUADS + RL_PATH_SAMPLE_QUADS;
  float confidence = uintBitsToFloat(RL_PAST_QUAD(gBuffers.reservoirs, state).w);
  return clamp(confidence, 1.0f, max(gFrame.radianceFrames, 1.0f));
}
