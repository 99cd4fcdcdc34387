// Functions that several shapes share.

// A point whose coordinates bound those of its computation. The caller sets the rest.
RL_FN ShapePoint shapePointOn(RL_IN(vec3) posL, RL_IN(vec3) normalL) {
  ShapePoint p;
  p.posL = posL;
  p.normalL = normalL;
  p.dpdu = vec3(1.0f, 0.0f, 0.0f);
  p.dpdv = vec3(0.0f, 1.0f, 0.0f);
  p.uv = vec2(0.0f, 0.0f);
  p.extent = vec3(1.0f, 1.0f, 1.0f);
  return p;
}

RL_FN ShapePoint shapePointNone() {
  return shapePointOn(vec3(0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f));
}

// Place on the circle as a number in [0, 1], without trigonometry: that of its direction on the
// square |x| + |y| = 1, from x to y.
RL_FN float shapeDiamond(RL_IN(vec2) at) {
  float x = at.x * rlSafeDivide(1.0f, abs(at.x) + abs(at.y));
  float turn = (1.0f - x) * 0.25f;
  return at.y >= 0.0f ? turn : 1.0f - turn;
}
RL_FN vec2 shapeFromDiamond(float turn) {
  bool isLower = turn > 0.5f;
  float x = 1.0f - 4.0f * (isLower ? 1.0f - turn : turn);
  float y = 1.0f - abs(x);
  return normalize(vec2(x, isLower ? -y : y));
}

// Angle of a direction (cosine, sine >= 0, of any length), radians in [0, pi].
RL_FN float shapeAngle(float cosine, float sine) { return atan(sine, cosine); }

// Turn from x to y, in [0, 1).
RL_FN float shapeTurn(RL_IN(vec2) at) {
  if (at.x == 0.0f && at.y == 0.0f) return 0.0f;
  float turn = atan(at.y, at.x) * (0.5f / RL_PI);
  return turn < 0.0f ? turn + 1.0f : turn;
}

// Angle from x to y of a direction of any length, radians in [-pi, pi]: a polynomial on an eighth
// of the circle, error below 4e-7. Drivers may return arc tangents with an error of 4096 units in
// the last place: too coarse where a density hangs on them.
RL_FN float shapeAngleOf(RL_IN(vec2) at) {
  float x = abs(at.x);
  float y = abs(at.y);
  bool isSteep = y > x;
  float t = rlSafeDivide(isSteep ? x : y, isSteep ? y : x);
  bool isFar = t > 0.41421356f;
  if (isFar) t = (t - 1.0f) / (t + 1.0f);
  float t2 = t * t;
  float angle =
      t +
      t * t2 * (-0.333332866f + t2 * (0.199912384f + t2 * (-0.140241429f + t2 * 0.0852049217f)));
  if (isFar) angle = 0.785398163f + angle;
  if (isSteep) angle = 1.57079633f - angle;
  if (at.x < 0.0f) angle = 3.14159265f - angle;
  return at.y < 0.0f ? -angle : angle;
}

// A word of a shape as numbers.
RL_FN vec4 shapeVec4(uint at) {
  uvec4 w = RL_SCENE_UVEC4(gScene.shapeWords, at);
  return vec4(uintBitsToFloat(w.x), uintBitsToFloat(w.y), uintBitsToFloat(w.z),
              uintBitsToFloat(w.w));
}

// Inverse of a direction for shapeEnterBox().
RL_FN vec3 shapeInverse(RL_IN(vec3) dir) {
  vec3 d = dir;
  if (abs(d.x) < 1.0e-18f) d.x = 1.0e-18f;
  if (abs(d.y) < 1.0e-18f) d.y = 1.0e-18f;
  if (abs(d.z) < 1.0e-18f) d.z = 1.0e-18f;
  return vec3(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
}

// Ray parameter at which a ray enters a box (two words: lower corner, upper corner), at least tMin;
// 3e38 on a miss. The exit is moved out by the rounding error of the slab test (Ize 2013).
RL_FN float shapeEnterBox(uint box, RL_IN(vec3) origin, RL_IN(vec3) inverse, float tMin,
                          float tMax) {
  vec3 a = (vec3(shapeVec4(box)) - origin) * inverse;
  vec3 b = (vec3(shapeVec4(box + 1u)) - origin) * inverse;
  vec3 enters = min(a, b);
  vec3 leaves = max(a, b);
  float enter = max(max(enters.x, enters.y), max(enters.z, tMin));
  float leave = min(min(leaves.x, leaves.y), leaves.z) * 1.0000008f;
  return enter <= leave && enter <= tMax ? enter : 3.0e38f;
}
