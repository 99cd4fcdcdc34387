// Layout of reservoir states in buffers. Relative error per channel: F at most 6.1e-5, the residual
// 1.2e-4. Two words of the last uvec4 are free for the sample.

RL_FN void reservoirStateWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(ReservoirState) r,
                               RL_IN(uvec2) rest) {
  uvec2 f = packPositive3(r.F);
  uvec2 residual = packSigned3(r.residual);
  RL_WRITE_UVEC4(words, at, uvec4(f.x, f.y, floatBitsToUint(r.W), floatBitsToUint(r.confidence)));
  RL_WRITE_UVEC4(words, at + 1u, uvec4(residual.x, residual.y, rest.x, rest.y));
}

RL_FN ReservoirState reservoirStateRead(RL_IN(Uvec4Ref) words, uint at, RL_OUT(uvec2) rest) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  ReservoirState r;
  r.F = unpackPositive3(q0.x, q0.y);
  r.W = uintBitsToFloat(q0.z);
  r.confidence = uintBitsToFloat(q0.w);
  r.residual = unpackSigned3(q1.x, q1.y);
  rest = uvec2(q1.z, q1.w);
  return r;
}

// Returns an empty reservoir of one frame (confidence 1).
RL_FN ReservoirState reservoirEmpty() {
  ReservoirState state;
  state.F = vec3(0.0f, 0.0f, 0.0f);
  state.W = 0.0f;
  state.residual = vec3(0.0f, 0.0f, 0.0f);
  state.confidence = 1.0f;
  return state;
}

// Resets and counts a reservoir with a NaN or Inf, which would spread by reuse.
RL_FN void reservoirGuard(RL_INOUT(ReservoirState) r) {
  if (rlIsFinite3(r.F * r.W + r.residual)) return;
  RL_HEALTH(RL_HEALTH_NONFINITE);
  r = reservoirEmpty();
}

// Stores the result of a shift and a word of the caller's in one uvec4.
RL_FN void shiftedWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(Shifted) s, uint other) {
  uvec2 f = packPositive3(s.F);
  RL_WRITE_UVEC4(words, at, uvec4(f.x, f.y, floatBitsToUint(s.jacobian), other));
}
RL_FN Shifted shiftedRead(RL_IN(Uvec4Ref) words, uint at, RL_OUT(uint) other) {
  uvec4 q = RL_EARLIER_UVEC4(words, at);
  Shifted s;
  s.F = unpackPositive3(q.x, q.y);
  s.jacobian = uintBitsToFloat(q.z);
  other = q.w;
  return s;
}
