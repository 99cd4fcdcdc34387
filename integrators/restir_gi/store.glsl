// Where restir_gi keeps reservoirs: those of this frame (initial, then merged over time) and those
// of the last one. Reads are of what earlier passes left (RL_PAST_QUAD): no pass reads what it has
// written itself.

RL_FN void giReadPath(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint slot,
                      RL_INOUT(PathSample) path) {
  pathSampleRead(quads, slot * RL_PATH_RESERVOIR_QUADS, path);
  if (RL_HAS(RL_FEATURE_GLOSSY)) pathSuffixRead(suffixes, slot * RL_PATH_SUFFIX_QUADS, path);
}
RL_FN void giReadState(RL_IN(QuadRef) quads, uint slot, RL_INOUT(ReservoirState) state) {
  reservoirStateRead(quads, slot * RL_PATH_RESERVOIR_QUADS + RL_PATH_SAMPLE_QUADS, state);
}
RL_FN void giWriteState(RL_IN(QuadRef) quads, uint slot, RL_IN(ReservoirState) state) {
  reservoirStateWrite(quads, slot * RL_PATH_RESERVOIR_QUADS + RL_PATH_SAMPLE_QUADS, state);
}
RL_FN void giWrite(RL_IN(QuadRef) quads, RL_IN(QuadRef) suffixes, uint slot,
                   RL_IN(PathReservoir) r) {
  pathSampleWrite(quads, slot * RL_PATH_RESERVOIR_QUADS, r.path);
  giWriteState(quads, slot, r.state);
  if (RL_HAS(RL_FEATURE_GLOSSY)) pathSuffixWrite(suffixes, slot * RL_PATH_SUFFIX_QUADS, r.path);
}

// Merges decide by states, and only the winner's path has to be moved: they are read on their own.
RL_FN void giReadPathNow(uint slot, RL_INOUT(PathSample) path) {
  giReadPath(gBuffers.reservoirs, gBuffers.suffixes, slot, path);
}
RL_FN void giReadPathBefore(uint slot, RL_INOUT(PathSample) path) {
  giReadPath(gBuffers.history, gBuffers.suffixesHistory, slot, path);
}
RL_FN void giReadStateNow(uint slot, RL_INOUT(ReservoirState) state) {
  giReadState(gBuffers.reservoirs, slot, state);
}
RL_FN void giReadStateBefore(uint slot, RL_INOUT(ReservoirState) state) {
  giReadState(gBuffers.history, slot, state);
}
RL_FN void giWriteStateNow(uint slot, RL_IN(ReservoirState) state) {
  giWriteState(gBuffers.reservoirs, slot, state);
}
RL_FN void giReadNow(uint slot, RL_INOUT(PathReservoir) r) {
  giReadPathNow(slot, r.path);
  giReadStateNow(slot, r.state);
}
RL_FN void giReadBefore(uint slot, RL_INOUT(PathReservoir) r) {
  giReadPathBefore(slot, r.path);
  giReadStateBefore(slot, r.state);
}
RL_FN void giWriteNow(uint slot, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.reservoirs, gBuffers.suffixes, slot, r);
}
RL_FN void giWriteHistory(uint slot, RL_IN(PathReservoir) r) {
  giWrite(gBuffers.history, gBuffers.suffixesHistory, slot, r);
}

// A slot's sample as its k-th partner sees it.
RL_FN uint giExchangeIndex(uint slot, uint k) { return slot * gParams.spatialNeighbours + k; }
RL_FN void giWriteShifted(uint index, RL_IN(Shifted) s) {
  RL_WRITE_QUAD(gBuffers.shifted, index, recordQuad(s.F, floatBitsToUint(s.jacobian)));
}
RL_FN Shifted giReadShifted(uint index) {
  uvec4 q = RL_PAST_QUAD(gBuffers.shifted, index);
  Shifted s;
  s.F = recordVec3(q);
  s.jacobian = uintBitsToFloat(q.w);
  return s;
}

// Of a history that goes on.
RL_FN float giNextAge(float before) { return min(before, gParams.confidenceCap) + 1.0f; }
// How many frames the history of a slot's pixel holds, this one included.
RL_FN float giAge(uint slot) { return uintBitsToFloat(RL_PAST_QUAD(gBuffers.own, slot).w); }
