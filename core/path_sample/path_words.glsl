// Words of a reservoir whose paths reconnect at x2 or at their light:
//   instance; primitive; barycentrics with the kind; film sample; geometry term; wi and pdfLight;
//   then the state, with the radiance of the path (core/resampling/reservoir.glsl)

// Writes the state and, of the path, only its radiance, which is stored with the state.
RL_FN void sampleStateWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  reservoirStateWrite(words, at + RL_PATH_SAMPLE_UVEC4S, r.state, packPositive3(r.path.radiance));
}

// Writes path and state. Barycentrics are kept to 2^-24, less than what rounding makes of a
// position.
RL_FN void sampleWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec2 wi = packUnit22(r.path.wi);
  uint pdf = packCut(r.path.pdfLight, 16u);
  RL_WRITE_UVEC4(
      words, at,
      uvec4(r.path.id.instance, r.path.id.primitive,
            packUnorm24(r.path.id.bary.x) | (r.path.kind << 24u), packUnorm24(r.path.id.bary.y)));
  RL_WRITE_UVEC4(words, at + 1u,
                 uvec4(r.path.film, floatBitsToUint(r.path.geometry), wi.x | (pdf << 24u),
                       wi.y | ((pdf >> 8u) << 24u)));
  sampleStateWrite(words, index, r);
}

RL_FN ReservoirState sampleStateRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec2 radiance;
  return reservoirStateRead(words, at + RL_PATH_SAMPLE_UVEC4S, radiance);
}

RL_FN PathReservoir sampleRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  uvec2 radiance;
  PathReservoir r;
  r.state = reservoirStateRead(words, at + RL_PATH_SAMPLE_UVEC4S, radiance);
  r.path.id.instance = q0.x;
  r.path.id.primitive = q0.y;
  r.path.id.bary = vec2(unpackUnorm24(q0.z & 0xffffffu), unpackUnorm24(q0.w & 0xffffffu));
  r.path.kind = q0.z >> 24u;
  r.path.film = q1.x;
  r.path.radiance = unpackPositive3(radiance.x, radiance.y);
  r.path.geometry = uintBitsToFloat(q1.y);
  r.path.wi = unpackUnit22(q1.z & 0xffffffu, q1.w & 0xffffffu);
  r.path.pdfLight = uintBitsToFloat(((q1.z >> 24u) | ((q1.w >> 24u) << 8u)) << 16u);
  r.path.base = 0u;
  r.path.key = 0u;
  return r;
}
