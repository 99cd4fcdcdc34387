// Words of a reservoir whose paths are replayed (RL_PATH_REPLAYS). The residual takes 48 bits here,
// the geometry term 20: sign-free, 8 of exponent and 12 of fraction, relative error 1.3e-4.
//   instance; primitive; barycentrics, kind, base and a part of the geometry term; film sample; key
//   of its random numbers; wi and pdfLight; F, W, confidence; residual with the rest of the
//   geometry term; radiance

RL_FN void sampleStateWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec2 f = packPositive3(r.state.F);
  uvec2 residual = packShared3(r.state.residual);
  uvec2 radiance = packPositive3(r.path.radiance);
  uint geometry = packCut(r.path.geometry, 11u);
  RL_WRITE_UVEC4(words, at + 2u,
                 uvec4(f.x, f.y, floatBitsToUint(r.state.W), floatBitsToUint(r.state.confidence)));
  RL_WRITE_UVEC4(words, at + 3u,
                 uvec4(residual.x, residual.y | ((geometry >> 4u) << 16u), radiance.x, radiance.y));
}

RL_FN void sampleWrite(RL_IN(Uvec4Ref) words, uint index, RL_IN(PathReservoir) r) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec2 wi = packUnit22(r.path.wi);
  uint pdf = packCut(r.path.pdfLight, 16u);
  uint geometry = packCut(r.path.geometry, 11u);
  RL_WRITE_UVEC4(
      words, at,
      uvec4(r.path.id.instance, r.path.id.primitive,
            packUnorm24(r.path.id.bary.x) | (r.path.kind << 24u),
            packUnorm24(r.path.id.bary.y) | (r.path.base << 24u) | ((geometry & 15u) << 28u)));
  RL_WRITE_UVEC4(words, at + 1u,
                 uvec4(r.path.film, r.path.key, wi.x | (pdf << 24u), wi.y | ((pdf >> 8u) << 24u)));
  sampleStateWrite(words, index, r);
}

RL_FN ReservoirState sampleStateRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec4 q2 = RL_EARLIER_UVEC4(words, at + 2u);
  uvec4 q3 = RL_EARLIER_UVEC4(words, at + 3u);
  ReservoirState state;
  state.F = unpackPositive3(q2.x, q2.y);
  state.W = uintBitsToFloat(q2.z);
  state.confidence = uintBitsToFloat(q2.w);
  state.residual = unpackShared3(q3.x, q3.y & 0xffffu);
  return state;
}

RL_FN PathReservoir sampleRead(RL_IN(Uvec4Ref) words, uint index) {
  uint at = index * RL_PATH_RESERVOIR_UVEC4S;
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  uvec4 q3 = RL_EARLIER_UVEC4(words, at + 3u);
  PathReservoir r;
  r.state = sampleStateRead(words, index);
  r.path.id.instance = q0.x;
  r.path.id.primitive = q0.y;
  r.path.id.bary = vec2(unpackUnorm24(q0.z & 0xffffffu), unpackUnorm24(q0.w & 0xffffffu));
  r.path.kind = q0.z >> 24u;
  r.path.base = (q0.w >> 24u) & 15u;
  r.path.film = q1.x;
  r.path.key = q1.y;
  r.path.radiance = unpackPositive3(q3.z, q3.w);
  r.path.geometry = uintBitsToFloat(((q0.w >> 28u) | ((q3.y >> 16u) << 4u)) << 11u);
  r.path.wi = unpackUnit22(q1.z & 0xffffffu, q1.w & 0xffffffu);
  r.path.pdfLight = uintBitsToFloat(((q1.z >> 24u) | ((q1.w >> 24u) << 8u)) << 16u);
  return r;
}
