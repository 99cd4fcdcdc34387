// To and from buffers: what every reservoir has, and the macros by which lists of fields become
// reads and writes of a payload, quad by quad. VF: three numbers and a float; VU: and a uint.

#define RL_PACK_VF(i, v, s) RL_WRITE_QUAD(quads, at + i, recordQuad(p.v, floatBitsToUint(p.s)));
#define RL_PACK_VU(i, v, s) RL_WRITE_QUAD(quads, at + i, recordQuad(p.v, p.s));
#define RL_UNPACK_VF(i, v, s)      \
  q = RL_PAST_QUAD(quads, at + i); \
  p.v = recordVec3(q);             \
  p.s = uintBitsToFloat(q.w);
#define RL_UNPACK_VU(i, v, s)      \
  q = RL_PAST_QUAD(quads, at + i); \
  p.v = recordVec3(q);             \
  p.s = q.w;

RL_FN void reservoirStateWrite(RL_IN(QuadRef) quads, uint at, RL_IN(ReservoirState) p) {
  RL_STATE_FIELDS(RL_PACK_VF, RL_PACK_VU);
}
RL_FN void reservoirStateRead(RL_IN(QuadRef) quads, uint at, RL_INOUT(ReservoirState) p) {
  uvec4 q;
  RL_STATE_FIELDS(RL_UNPACK_VF, RL_UNPACK_VU);
}

// Of this frame, with nothing in it.
RL_FN ReservoirState reservoirEmpty() {
  ReservoirState state;
  state.F = vec3(0.0f, 0.0f, 0.0f);
  state.W = 0.0f;
  state.residual = vec3(0.0f, 0.0f, 0.0f);
  state.confidence = 1.0f;
  return state;
}
