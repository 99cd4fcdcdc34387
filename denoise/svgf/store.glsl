// svgf: data that passes and frames leave to each other.

RL_FN bool svgfHas(uint flag) { return (gParams.flags & flag) != 0u; }

RL_FN Filtered svgfRead(uint pixelIndex, uint step) {
  if ((step & 1u) == 0u) return filterRead(gBuffers.even, pixelIndex);
  return filterRead(gBuffers.odd, pixelIndex);
}

RL_FN SvgfHistory svgfNoHistory() {
  SvgfHistory h;
  h.light = vec3(0.0f, 0.0f, 0.0f);
  h.frames = 0.0f;
  h.reflectance = vec3(0.0f, 0.0f, 0.0f);
  h.mean = 0.0f;
  h.spread = 0.0f;
  h.step = 0.0f;
  h.last = 0.0f;
  return h;
}
RL_FN SvgfHistory svgfHistoryRead(RL_IN(Uvec4Ref) words, uint pixelIndex) {
  vec4 q0 = recordVec4(RL_EARLIER_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S));
  vec4 q1 = recordVec4(RL_EARLIER_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S + 1u));
  vec4 q2 = recordVec4(RL_EARLIER_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S + 2u));
  SvgfHistory h;
  h.reflectance = vec3(q2.x, q2.y, q2.z);
  h.light = vec3(q0.x, q0.y, q0.z);
  h.frames = q0.w;
  h.mean = q1.x;
  h.spread = q1.y;
  h.step = q1.z;
  h.last = q1.w;
  return h;
}
RL_FN void svgfHistoryWriteLight(RL_IN(Uvec4Ref) words, uint pixelIndex, RL_IN(vec3) light,
                                 float frames) {
  RL_WRITE_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S,
                 recordUvec4(light, floatBitsToUint(frames)));
}
RL_FN void svgfHistoryWrite(RL_IN(Uvec4Ref) words, uint pixelIndex, RL_IN(SvgfHistory) h) {
  svgfHistoryWriteLight(words, pixelIndex, h.light, h.frames);
  RL_WRITE_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S + 1u,
                 uvec4(floatBitsToUint(h.mean), floatBitsToUint(h.spread), floatBitsToUint(h.step),
                       floatBitsToUint(h.last)));
  RL_WRITE_UVEC4(words, pixelIndex * RL_SVGF_HISTORY_UVEC4S + 2u, recordUvec4(h.reflectance, 0u));
}

// Reduces a number of frames by the turn of the view: a glossy lobe sends other light to another
// view.
RL_FN float svgfInView(float frames, uint pixelIndex) {
  float turn = motionRead(gBuffers.motion, pixelIndex).turn * gParams.lobeRotationResponse;
  return frames / (1.0f + frames * turn);
}

// Number of frames that the radiance itself averages, this one included; at most `frames`.
RL_FN float svgfEffectiveHistoryLength(uint pixelIndex, float frames) {
  if (!svgfHas(RL_SVGF_CONFIDENCE)) return 1.0f;
  float averaged = gFrame.radianceFrames;
  if (svgfHas(RL_SVGF_EFFECTIVE)) averaged = gBuffers.radianceFrames.data[pixelIndex];
  return clamp(averaged, 1.0f, max(frames, 1.0f));
}
