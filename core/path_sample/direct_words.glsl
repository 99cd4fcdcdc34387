// Words of a reservoir of direct light (RL_DIRECT_ONLY): light (28 bits) and its coordinates, W,
// confidence; film sample, F, residual.

RL_FN void sampleWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  uint at = index * RL_DIRECT_RESERVOIR_UVEC4S;
  uvec2 c = directCoordinates(r.path);
  uvec2 f = packShared3(r.state.F);
  uvec2 residual = packShared3(r.state.residual);
  RL_WRITE_UVEC4(words, at,
                 uvec4((r.path.id.instance & 0xfffffffu) | (c.x << 28u), (c.x >> 4u) | (c.y << 14u),
                       floatBitsToUint(r.state.W), floatBitsToUint(r.state.confidence)));
  RL_WRITE_UVEC4(words, at + 1u, uvec4(r.path.film, f.x, residual.x, f.y | (residual.y << 16u)));
}

// Writes all of it: the state shares its words with the path.
RL_FN void sampleStateWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  sampleWrite(words, index, r);
}

RL_FN ReservoirState sampleStateRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_DIRECT_RESERVOIR_UVEC4S;
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  ReservoirState state;
  state.F = unpackShared3(q1.y, q1.w & 0xffffu);
  state.W = uintBitsToFloat(q0.z);
  state.residual = unpackShared3(q1.z, q1.w >> 16u);
  state.confidence = uintBitsToFloat(q0.w);
  return state;
}

RL_FN PathReservoir sampleRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_DIRECT_RESERVOIR_UVEC4S;
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  PathReservoir r;
  r.state = sampleStateRead(words, index);
  r.path.id = surfaceIdNone();
  r.path.id.instance = q0.x & 0xfffffffu;
  r.path.kind = RL_PATH_DIRECT;
  r.path.film = q1.x;
  r.path.radiance = vec3(0.0f, 0.0f, 0.0f);
  r.path.geometry = 0.0f;
  r.path.pdfLight = 0.0f;
  r.path.base = 0u;
  r.path.key = 0u;
  // An empty reservoir names no light.
  if (r.state.W > 0.0f)
    r.path.kind |= recordLight(r.path.id.instance).kind << RL_PATH_LIGHT_KIND_SHIFT;
  directSetCoordinates(r.path, uvec2((q0.x >> 28u) | ((q0.y & 0x3fffu) << 4u), q0.y >> 14u));
  return r;
}
