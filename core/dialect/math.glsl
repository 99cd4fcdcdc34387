// Small math functions, written out so that every device computes the same value.

RL_FN bool rlIsFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

RL_FN bool rlIsFinite3(RL_IN(vec3) v) { return rlIsFinite(v.x + v.y + v.z); }

RL_FN float rlMax3(RL_IN(vec3) v) { return max(v.x, max(v.y, v.z)); }

// Luminance of linear Rec. 709.
RL_FN real rlLuminance(RL_IN(real3) c) {
  return real(0.212639f) * c.x + real(0.715169f) * c.y + real(0.072192f) * c.z;
}

RL_FN bool rlIsBlack(RL_IN(vec3) c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }

// x / y with 0 for y == 0.
RL_FN float rlSafeDivide(float x, float y) { return y != 0.0f ? x / y : 0.0f; }

// log(1 - x) and 1 - exp(-x), also for x so small that float32 has no 1 - x.
RL_FN float rlLogOneMinus(float x) {
  return x < 1.0e-3f ? -x * (1.0f + 0.5f * x) : log(max(1.0f - x, 1.0e-30f));
}
RL_FN float rlOneMinusExp(float x) { return x < 1.0e-3f ? x * (1.0f - 0.5f * x) : 1.0f - exp(-x); }

// High 32 bits of a 32 x 32 bit product: maps random bits uniformly to [0, n).
RL_FN uint rlMulHigh(uint a, uint b) {
  uint aLow = a & 0xffffu;
  uint aHigh = a >> 16u;
  uint bLow = b & 0xffffu;
  uint bHigh = b >> 16u;
  uint middle = aHigh * bLow + ((aLow * bLow) >> 16u);
  uint middle2 = aLow * bHigh + (middle & 0xffffu);
  return aHigh * bHigh + (middle >> 16u) + (middle2 >> 16u);
}

// (cos, sin) of 2 pi u for u in [0, 1): polynomials on an eighth of the circle, error below 1e-6.
RL_FN vec2 rlCosSin2Pi(float u) {
  float x = u * 4.0f;
  uint quadrant = uint(x + 0.5f);
  float a = (x - float(quadrant)) * 1.57079632679490f;
  float a2 = a * a;
  float s = a * (1.0f +
                 a2 * (-0.166666667f + a2 * (8.33333310e-3f + a2 * (-1.98400e-4f + a2 * 2.7e-6f))));
  float c = 1.0f + a2 * (-0.5f + a2 * (4.16666642e-2f + a2 * (-1.38887e-3f + a2 * 2.47e-5f)));
  uint q = quadrant & 3u;
  if (q == 0u) return vec2(c, s);
  if (q == 1u) return vec2(-s, c);
  if (q == 2u) return vec2(-c, -s);
  return vec2(s, -c);
}
