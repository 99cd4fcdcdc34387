// Layout of a BSDF in buffers: relative error of colours at most 6.1e-5. Three words of the last
// uvec4 are free for the caller.

RL_FN void bsdfWrite(RL_IN(Uvec4Ref) words, uint at, RL_IN(Bsdf) b, RL_IN(uvec3) rest) {
  uvec2 diffuse = packPositive3(b.diffuse);
  uvec2 f0 = packPositive3(b.f0);
  uvec2 transmission = packPositive3(b.transmission);
  RL_WRITE_UVEC4(words, at, uvec4(diffuse.x, diffuse.y, f0.x, f0.y));
  RL_WRITE_UVEC4(words, at + 1u,
                 uvec4(transmission.x, transmission.y, floatBitsToUint(b.alpha),
                       packNearest24(b.f90, b.lobes)));
  RL_WRITE_UVEC4(words, at + 2u, uvec4(floatBitsToUint(b.eta), rest.x, rest.y, rest.z));
}

RL_FN Bsdf bsdfRead(RL_IN(Uvec4Ref) words, uint at, RL_OUT(uvec3) rest) {
  uvec4 q0 = RL_EARLIER_UVEC4(words, at);
  uvec4 q1 = RL_EARLIER_UVEC4(words, at + 1u);
  uvec4 q2 = RL_EARLIER_UVEC4(words, at + 2u);
  Bsdf b;
  b.diffuse = unpackPositive3(q0.x, q0.y);
  b.f0 = unpackPositive3(q0.z, q0.w);
  b.transmission = unpackPositive3(q1.x, q1.y);
  b.alpha = uintBitsToFloat(q1.z);
  b.f90 = unpack24(q1.w);
  b.lobes = q1.w & 0xffu;
  b.eta = uintBitsToFloat(q2.x);
  rest = uvec3(q2.y, q2.z, q2.w);
  return b;
}
