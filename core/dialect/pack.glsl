// Packs numbers into fewer bits, for per-pixel buffers.

// Drops the last `bits` bits of a float, rounded to nearest. Keeps infinities and NaNs.
RL_FN uint packCut(float x, uint bits) {
  return (floatBitsToUint(x) + (1u << (bits - 1u))) >> bits;
}

// Packs three non-negative floats into 21 bits each: 8 bits of exponent, 13 of fraction. Relative
// error at most 6.1e-5.
RL_FN uvec2 packPositive3(RL_IN(vec3) v) {
  uint z = packCut(v.z, 10u) & 0x1fffffu;
  return uvec2((packCut(v.x, 10u) & 0x1fffffu) | (z << 21u),
               (packCut(v.y, 10u) & 0x1fffffu) | ((z >> 11u) << 21u));
}
RL_FN vec3 unpackPositive3(uint w0, uint w1) {
  uint z = (w0 >> 21u) | ((w1 >> 21u) << 11u);
  return vec3(uintBitsToFloat((w0 & 0x1fffffu) << 10u), uintBitsToFloat((w1 & 0x1fffffu) << 10u),
              uintBitsToFloat(z << 10u));
}

// Packs three floats into 21 bits each: sign, 8 bits of exponent, 12 of fraction. Relative error at
// most 1.2e-4.
RL_FN uvec2 packSigned3(RL_IN(vec3) v) {
  uint z = packCut(v.z, 11u);
  return uvec2(packCut(v.x, 11u) | (z << 21u), packCut(v.y, 11u) | ((z >> 11u) << 21u));
}
RL_FN vec3 unpackSigned3(uint w0, uint w1) {
  uint z = (w0 >> 21u) | ((w1 >> 21u) << 11u);
  return vec3(uintBitsToFloat(w0 << 11u), uintBitsToFloat(w1 << 11u), uintBitsToFloat(z << 11u));
}

// Unit vectors as two numbers in [-1, 1], by the octahedral map (Cigolle et al., "A Survey of
// Efficient Representations for Independent Unit Vectors", JCGT 2014). The zero vector becomes the
// z axis.
RL_FN vec2 packOctahedron(RL_IN(vec3) n) {
  float scale = rlSafeDivide(1.0f, abs(n.x) + abs(n.y) + abs(n.z));
  float x = n.x * scale;
  float y = n.y * scale;
  if (!(n.z < 0.0f)) return vec2(x, y);
  return vec2((1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f),
              (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f));
}
RL_FN vec3 unpackOctahedron(float x, float y) {
  float z = 1.0f - abs(x) - abs(y);
  if (!(z < 0.0f)) return normalize(vec3(x, y, z));
  return normalize(vec3((1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f),
                        (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f), z));
}

// Packs three floats of any sign into 48 bits: each a sign and 12 bits, and one exponent for all.
// Error at most 2.5e-4 of the greatest; what is below 1e-34 or not finite becomes 0.
RL_FN uvec2 packShared3(RL_IN(vec3) v) {
  float greatest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  // Rounding may reach the next power of 2.
  uint exponent = (floatBitsToUint(greatest) + 0x800u) >> 23u;
  if (exponent < 13u || exponent > 254u) return uvec2(0u, 0u);
  float scale = uintBitsToFloat((265u - exponent) << 23u);
  uint x = uint(abs(v.x) * scale + 0.5f) | (v.x < 0.0f ? 0x1000u : 0u);
  uint y = uint(abs(v.y) * scale + 0.5f) | (v.y < 0.0f ? 0x1000u : 0u);
  uint z = uint(abs(v.z) * scale + 0.5f) | (v.z < 0.0f ? 0x1000u : 0u);
  return uvec2(x | (y << 13u) | (exponent << 26u), z | ((exponent >> 6u) << 13u));
}
RL_FN float unpackSharedPart(uint bits, float scale) {
  float x = float(bits & 0xfffu) * scale;
  return (bits & 0x1000u) != 0u ? -x : x;
}
RL_FN vec3 unpackShared3(uint w0, uint w1) {
  uint exponent = (w0 >> 26u) | (((w1 >> 13u) & 3u) << 6u);
  if (exponent < 13u) return vec3(0.0f, 0.0f, 0.0f);
  float scale = uintBitsToFloat((exponent - 11u) << 23u);
  return vec3(unpackSharedPart(w0, scale), unpackSharedPart(w0 >> 13u, scale),
              unpackSharedPart(w1, scale));
}

// A number in [0, 1] as 24 bits.
RL_FN uint packUnorm24(float x) { return uint(clamp(x * 16777216.0f + 0.5f, 0.0f, 16777215.0f)); }
RL_FN float unpackUnorm24(uint packed) { return float(packed) * (1.0f / 16777216.0f); }

// Packs a unit vector into two 22-bit numbers, error at most 1.5e-6. Packing what was unpacked
// gives the same numbers: their steps are coarser than what rounding makes of a unit vector.
RL_FN uvec2 packUnit22(RL_IN(vec3) n) {
  vec2 p = packOctahedron(n);
  vec2 q = clamp(p * 0.5f + 0.5f, vec2(0.0f, 0.0f), vec2(1.0f, 1.0f)) * 4194303.0f;
  return uvec2(uint(q.x + 0.5f), uint(q.y + 0.5f));
}
RL_FN vec3 unpackUnit22(uint x, uint y) {
  return unpackOctahedron(float(x) * (2.0f / 4194303.0f) - 1.0f,
                          float(y) * (2.0f / 4194303.0f) - 1.0f);
}

// Packs a unit vector into two 16-bit numbers, error at most 1e-4.
RL_FN uint packNormal(RL_IN(vec3) n) {
  vec2 p = packOctahedron(n);
  uint x = uint(clamp(p.x * 0.5f + 0.5f, 0.0f, 1.0f) * 65535.0f + 0.5f);
  uint y = uint(clamp(p.y * 0.5f + 0.5f, 0.0f, 1.0f) * 65535.0f + 0.5f);
  return x | (y << 16u);
}
RL_FN vec3 unpackNormal(uint packed) {
  return unpackOctahedron(float(packed & 0xffffu) * (2.0f / 65535.0f) - 1.0f,
                          float(packed >> 16u) * (2.0f / 65535.0f) - 1.0f);
}

// Packs three numbers in [0, 1] into 10 bits each; the upper two bits are free.
RL_FN uint packColor(RL_IN(vec3) c) {
  uint r = uint(clamp(c.x, 0.0f, 1.0f) * 1023.0f + 0.5f);
  uint g = uint(clamp(c.y, 0.0f, 1.0f) * 1023.0f + 0.5f);
  uint b = uint(clamp(c.z, 0.0f, 1.0f) * 1023.0f + 0.5f);
  return r | (g << 10u) | (b << 20u);
}
RL_FN vec3 unpackColor(uint packed) {
  return vec3(float(packed & 0x3ffu), float((packed >> 10u) & 0x3ffu),
              float((packed >> 20u) & 0x3ffu)) *
         (1.0f / 1023.0f);
}

// Both halves of 32 bits, as floats that no machine changes on their way.
RL_FN vec2 packHalves(uint bits) { return vec2(float(bits & 0xffffu), float(bits >> 16u)); }
RL_FN uint unpackHalves(RL_IN(vec2) halves) { return uint(halves.x) | (uint(halves.y) << 16u); }
