// The value of a field, with its derivative along a direction.

RL_FN Field fieldOf(RL_IN(Shape) shape) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord + 1u);
  Field f;
  f.low = vec3(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z));
  f.high = vec3(uintBitsToFloat(q1.x), uintBitsToFloat(q1.y), uintBitsToFloat(q1.z));
  f.first = shape.firstWord + RL_FIELD_HEADER;
  f.count = q0.w;
  return f;
}

// (cos, sin), |x| at most 8192: Cody and Waite's reduction, polynomials on an eighth of the circle.
RL_FN vec2 fieldCosSin(float x) {
  float k = floor(x * 0.636619772f + 0.5f);
  float a = ((x - k * 1.5703125f) - k * 4.837512969970703125e-4f) - k * 7.54978995489e-8f;
  float a2 = a * a;
  float s = a + a * a2 * (-1.6666654611e-1f + a2 * (8.3321608736e-3f + a2 * -1.9515295891e-4f));
  float c = 1.0f - 0.5f * a2 +
            a2 * a2 * (4.166664568298827e-2f + a2 * (-1.388731625493765e-3f + a2 * 2.443316e-5f));
  uint quadrant = uint(k - 4.0f * floor(k * 0.25f)) & 3u;
  if (quadrant == 0u) return vec2(c, s);
  if (quadrant == 1u) return vec2(-s, c);
  if (quadrant == 2u) return vec2(-c, -s);
  return vec2(s, -c);
}

RL_FN float fieldExp(float exponent) {
  float x = clamp(exponent, -80.0f, 80.0f);
  float k = floor(x * 1.44269504f + 0.5f);
  float r = (x - k * 0.693359375f) + k * 2.12194440e-4f;
  float p = 1.3981999507e-3f + r * 1.9875691500e-4f;
  p = 4.1665795894e-2f + r * (8.3334519073e-3f + r * p);
  p = 0.5f + r * (1.6666665459e-1f + r * p);
  return (1.0f + (r + r * r * p)) * uintBitsToFloat(uint(k + 127.0f) << 23u);
}

// x less the nearest even number, in [-1, 1].
RL_FN float fieldFromEven(float x) { return x - 2.0f * floor(x * 0.5f + 0.5f); }

// Value at a place, and derivative along a direction (of any length).
RL_FN_OUTLINE vec2 fieldSlope(RL_IN(Field) f, RL_IN(vec3) at, RL_IN(vec3) dir) {
  FieldSlopes regs;
  regs.r[0] = vec2(at.x, dir.x);
  regs.r[1] = vec2(at.y, dir.y);
  regs.r[2] = vec2(at.z, dir.z);
  vec2 v = regs.r[0];
  for (uint i = 0u; i < f.count; i = i + 1u) {
    uvec4 q = RL_SCENE_UVEC4(gScene.shapeWords, f.first + i);
    uint kind = q.x & 255u;
    vec2 a = regs.r[(q.x >> 16u) & 255u];
    vec2 b = regs.r[q.x >> 24u];
    float k = uintBitsToFloat(q.y);
    if (kind == RL_FIELD_LINEAR) {
      v = vec2(k * a.x + uintBitsToFloat(q.z), k * a.y);
    } else if (kind == RL_FIELD_ADD) {
      v = a + b;
    } else if (kind == RL_FIELD_SUBTRACT) {
      v = a - b;
    } else if (kind == RL_FIELD_MULTIPLY) {
      v = vec2(a.x * b.x, a.x * b.y + a.y * b.x);
    } else if (kind == RL_FIELD_SQUARE) {
      v = vec2(a.x * a.x, 2.0f * a.x * a.y);
    } else if (kind == RL_FIELD_SQRT) {
      float root = sqrt(max(a.x, 0.0f));
      v = vec2(root, rlSafeDivide(0.5f * a.y, root));
    } else if (kind == RL_FIELD_LENGTH) {
      float size = sqrt(a.x * a.x + b.x * b.x);
      v = vec2(size, rlSafeDivide(a.x * a.y + b.x * b.y, size));
    } else if (kind == RL_FIELD_MIN) {
      v = a.x <= b.x ? a : b;
    } else if (kind == RL_FIELD_MAX) {
      v = a.x >= b.x ? a : b;
    } else if (kind == RL_FIELD_ABS) {
      v = a.x < 0.0f ? -a : a;
    } else if (kind == RL_FIELD_PLANE) {
      float m = uintBitsToFloat(q.z);
      float n = uintBitsToFloat(q.w);
      v = k * regs.r[0] + m * regs.r[1] + n * regs.r[2];
    } else if (kind == RL_FIELD_SIN) {
      vec2 wave = fieldCosSin(a.x);
      v = vec2(wave.y, wave.x * a.y);
    } else if (kind == RL_FIELD_COS) {
      vec2 wave = fieldCosSin(a.x);
      v = vec2(wave.x, -wave.y * a.y);
    } else if (kind == RL_FIELD_EXP) {
      float e = fieldExp(a.x);
      v = vec2(e, e * a.y);
    } else if (kind == RL_FIELD_RECIPROCAL) {
      float inverse = rlSafeDivide(1.0f, a.x);
      v = vec2(inverse, -inverse * inverse * a.y);
    } else if (kind == RL_FIELD_GRID) {
      vec2 c = regs.r[q.y];
      v = fieldGridSlope(f.first + q.z, vec3(a.x, b.x, c.x), vec3(a.y, b.y, c.y));
    } else {
      float away = fieldFromEven(a.x);
      v = away < 0.0f ? vec2(-away, -a.y) : vec2(away, a.y);
    }
    regs.r[(q.x >> 8u) & 255u] = v;
  }
  return v;
}

RL_FN vec3 fieldAxis(uint axis) {
  return vec3(axis == 0u ? 1.0f : 0.0f, axis == 1u ? 1.0f : 0.0f, axis == 2u ? 1.0f : 0.0f);
}

RL_FN vec3 fieldGradient(RL_IN(Field) f, RL_IN(vec3) at) {
  vec2 x = fieldSlope(f, at, fieldAxis(0u));
  vec2 y = fieldSlope(f, at, fieldAxis(1u));
  vec2 z = fieldSlope(f, at, fieldAxis(2u));
  return vec3(x.y, y.y, z.y);
}
