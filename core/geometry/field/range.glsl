// Bounds of a field and of its derivative along a ray, over a segment of the ray: interval
// arithmetic. A value that fieldSlope() computes on the segment, on any device, lies in the bounds.

// Bounds over the box of two ends, of which the ray goes from one to the other along dir: (least
// value, largest value, least derivative, largest derivative).
RL_FN_OUTLINE vec4 fieldRange(RL_IN(Field) f, RL_IN(vec3) from, RL_IN(vec3) to, RL_IN(vec3) dir) {
  FieldRanges regs;
  regs.r[0] = vec4(min(from.x, to.x), max(from.x, to.x), dir.x, dir.x);
  regs.r[1] = vec4(min(from.y, to.y), max(from.y, to.y), dir.y, dir.y);
  regs.r[2] = vec4(min(from.z, to.z), max(from.z, to.z), dir.z, dir.z);
  vec4 all = regs.r[0];
  for (uint i = 0u; i < f.count; i = i + 1u) {
    uvec4 q = RL_SCENE_UVEC4(gScene.shapeWords, f.first + i);
    uint kind = q.x & 255u;
    vec4 ra = regs.r[(q.x >> 16u) & 255u];
    vec4 rb = regs.r[q.x >> 24u];
    vec2 a = vec2(ra.x, ra.y);
    vec2 da = vec2(ra.z, ra.w);
    vec2 b = vec2(rb.x, rb.y);
    vec2 db = vec2(rb.z, rb.w);
    float k = uintBitsToFloat(q.y);
    vec2 v = a;
    vec2 d = da;
    if (kind == RL_FIELD_LINEAR) {
      float m = uintBitsToFloat(q.z);
      v = fieldSum(fieldTimes(k, a), vec2(m, m));
      d = fieldTimes(k, da);
    } else if (kind == RL_FIELD_ADD) {
      v = fieldSum(a, b);
      d = fieldSum(da, db);
    } else if (kind == RL_FIELD_SUBTRACT) {
      v = fieldSum(a, vec2(-b.y, -b.x));
      d = fieldSum(da, vec2(-db.y, -db.x));
    } else if (kind == RL_FIELD_MULTIPLY) {
      v = fieldProduct(a, b);
      d = fieldSum(fieldProduct(a, db), fieldProduct(da, b));
    } else if (kind == RL_FIELD_SQUARE) {
      v = fieldSquareRange(a);
      d = fieldProduct(2.0f * a, da);
    } else if (kind == RL_FIELD_SQRT) {
      v = sqrt(max(a, vec2(0.0f, 0.0f)));
      vec2 steep = vec2(min(0.5f / max(v.y, 1.0e-18f), RL_FIELD_STEEPEST),
                        min(0.5f / max(v.x, 1.0e-18f), RL_FIELD_STEEPEST));
      if (a.x <= 0.0f) steep.x = 0.0f;
      v = fieldWidenCoarsely(v);
      v.x = max(v.x, 0.0f);
      d = fieldProduct(steep, da);
    } else if (kind == RL_FIELD_LENGTH) {
      vec2 squares = fieldSum(fieldSquareRange(a), fieldSquareRange(b));
      v = fieldWidenCoarsely(sqrt(max(squares, vec2(0.0f, 0.0f))));
      v.x = max(v.x, 0.0f);
      d = fieldSum(fieldProduct(fieldShare(a, b), da), fieldProduct(fieldShare(b, a), db));
      // Cauchy and Schwarz: never above the length of the derivatives.
      float x = max(abs(da.x), abs(da.y));
      float y = max(abs(db.x), abs(db.y));
      float most = sqrt(x * x + y * y) * 1.000001f;
      d = clamp(d, vec2(-most, -most), vec2(most, most));
    } else if (kind == RL_FIELD_MIN) {
      v = min(a, b);
      d = vec2(min(da.x, db.x), max(da.y, db.y));
      if (a.y < b.x) d = da;
      if (b.y < a.x) d = db;
    } else if (kind == RL_FIELD_MAX) {
      v = max(a, b);
      d = vec2(min(da.x, db.x), max(da.y, db.y));
      if (a.x > b.y) d = da;
      if (b.x > a.y) d = db;
    } else if (kind == RL_FIELD_ABS) {
      if (a.y < 0.0f) {
        v = vec2(-a.y, -a.x);
        d = vec2(-da.y, -da.x);
      } else if (a.x <= 0.0f) {
        v = vec2(0.0f, max(-a.x, a.y));
        float steepest = max(-da.x, da.y);
        steepest = max(steepest, max(da.x, -da.y));
        d = vec2(-steepest, steepest);
      }
    } else if (kind == RL_FIELD_PLANE) {
      float m = uintBitsToFloat(q.z);
      float n = uintBitsToFloat(q.w);
      v = fieldTimes(k, vec2(regs.r[0].x, regs.r[0].y));
      v = fieldSum(v, fieldTimes(m, vec2(regs.r[1].x, regs.r[1].y)));
      v = fieldSum(v, fieldTimes(n, vec2(regs.r[2].x, regs.r[2].y)));
      float slope = k * dir.x + m * dir.y + n * dir.z;
      float slack = RL_FIELD_ROUNDING * (abs(k * dir.x) + abs(m * dir.y) + abs(n * dir.z));
      d = vec2(slope - slack, slope + slack);
    } else if (kind == RL_FIELD_SIN) {
      v = fieldWave(a, false);
      d = fieldProduct(fieldWave(a, true), da);
    } else if (kind == RL_FIELD_COS) {
      v = fieldWave(a, true);
      vec2 sine = fieldWave(a, false);
      d = fieldProduct(vec2(-sine.y, -sine.x), da);
    } else if (kind == RL_FIELD_EXP) {
      v = vec2(fieldExp(a.x), fieldExp(a.y));
      v = vec2(v.x * 0.999999f, min(v.y * 1.000001f, RL_FIELD_STEEPEST));
      d = fieldProduct(v, da);
    } else if (kind == RL_FIELD_RECIPROCAL) {
      // The program of a shape that divides by 0 in its box is refused.
      v = vec2(rlSafeDivide(1.0f, a.y), rlSafeDivide(1.0f, a.x));
      v = fieldWidenCoarsely(vec2(min(v.x, v.y), max(v.x, v.y)));
      vec2 squared = fieldSquareRange(v);
      d = fieldProduct(vec2(-squared.y, -squared.x), da);
    } else if (kind == RL_FIELD_GRID) {
      vec4 range = fieldGridRange(f.first + q.z, ra, rb, regs.r[q.y]);
      v = vec2(range.x, range.y);
      d = vec2(range.z, range.w);
    } else {
      float x = abs(fieldFromEven(a.x));
      float y = abs(fieldFromEven(a.y));
      bool hasEven = fieldHolds(a, 2.0f, 0.0f);
      bool hasOdd = fieldHolds(a, 2.0f, 1.0f);
      v = vec2(hasEven ? 0.0f : min(x, y), hasOdd ? 1.0f : max(x, y));
      v = vec2(max(v.x - 2.0e-7f * abs(a.x), 0.0f), min(v.y + 2.0e-7f * abs(a.y), 1.0f));
      bool isFalling = fieldFromEven(0.5f * (a.x + a.y)) < 0.0f;
      if (isFalling) d = vec2(-da.y, -da.x);
      if (hasEven || hasOdd) d = vec2(min(da.x, -da.y), max(da.y, -da.x));
    }
    all = vec4(v.x, v.y, d.x, d.y);
    regs.r[(q.x >> 8u) & 255u] = all;
  }
  return all;
}
