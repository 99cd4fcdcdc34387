// The first point of a ray where a field crosses 0.
//
// The ray is cut into segments whose bounds (range.glsl) say that there is no crossing, or that the
// field falls or rises all along: then the signs of the ends tell. From the value at the beginning
// and the least derivative follows how far the ray goes free (Galin et al., "Segment Tracing Using
// Local Lipschitz Bounds", 2020). A hit is the first number behind a change of sign, so that a ray
// that goes on from there does not meet it again.

// The place at t, of a line from where the ray enters the box: the same whatever part is searched.
RL_FN vec3 fieldPlace(RL_IN(vec3) base, RL_IN(vec3) dir, float t) { return base + dir * t; }

// Parameters at which a line enters and leaves the box; x > y: it misses.
RL_FN vec2 fieldClip(RL_IN(Field) f, RL_IN(Ray) ray) {
  vec2 inside = vec2(-3.0e38f, 3.0e38f);
  for (uint axis = 0u; axis < 3u; axis = axis + 1u) {
    vec3 unit = fieldAxis(axis);
    float o = dot(unit, ray.origin);
    float d = dot(unit, ray.dir);
    float low = dot(unit, f.low);
    float high = dot(unit, f.high);
    if (abs(d) < 1.0e-30f) {
      if (o < low || o > high) return vec2(1.0f, 0.0f);
      continue;
    }
    float inverse = 1.0f / d;
    float a = (low - o) * inverse;
    float b = (high - o) * inverse;
    inside = vec2(max(inside.x, min(a, b)), min(inside.y, max(a, b)));
  }
  return inside;
}

// Narrows a change of sign between t.x and t.y to a few units in the last place: Newton's steps
// from the end with the smaller value, a little too far, so that both ends move; else halves.
RL_FN vec2 fieldRefine(RL_IN(Field) f, RL_IN(vec3) base, RL_IN(vec3) dir, RL_IN(vec2) between,
                       RL_IN(vec2) atLow, RL_IN(vec2) atHigh) {
  vec2 t = between;
  vec2 low = atLow;
  vec2 high = atHigh;
  float least = 2.384185791015625e-7f * max(abs(t.x), abs(t.y));
  for (uint i = 0u; i < 64u; i = i + 1u) {
    float width = t.y - t.x;
    if (!(width > least)) break;
    bool fromLow = abs(low.x) < abs(high.x);
    vec2 at = fromLow ? low : high;
    float tAt = fromLow ? t.x : t.y;
    float tNext = tAt - rlSafeDivide(at.x, at.y) + (fromLow ? 0.5f : -0.5f) * least;
    if ((i & 3u) == 3u || !(tNext > t.x) || !(tNext < t.y)) tNext = t.x + 0.5f * width;
    if (!(tNext > t.x) || !(tNext < t.y)) break;
    vec2 next = fieldSlope(f, fieldPlace(base, dir, tNext), dir);
    if ((next.x < 0.0f) == (low.x < 0.0f)) {
      t.x = tNext;
      low = next;
    } else {
      t.y = tNext;
      high = next;
    }
  }
  return t;
}

// Finds the segment in which the sign changes first: (begin, end) of it, or begin > end.
RL_FN vec2 fieldSearch(RL_IN(Field) f, RL_IN(vec3) base, RL_IN(vec3) dir, RL_IN(vec2) within) {
  vec2 none = vec2(1.0f, 0.0f);
  float least = max((within.y - within.x) * RL_FIELD_SHORTEST, 4.8e-7f * abs(within.y));
  float t = within.x;
  float width = within.y - within.x;
  vec3 at = fieldPlace(base, dir, t);
  float value = fieldSlope(f, at, dir).x;
  bool isInside = value < 0.0f;
  for (uint i = 0u; i < RL_FIELD_SEGMENTS; i = i + 1u) {
    float tNext = t + width;
    if (!(tNext < within.y)) tNext = within.y;
    vec3 next = fieldPlace(base, dir, tNext);
    vec4 range = fieldRange(f, at, next, dir);
    if (isInside) range = vec4(-range.y, -range.x, -range.w, -range.z);
    float span = tNext - t;
    bool isFree = range.x > 0.0f || range.z >= 0.0f;
    float reach = isFree ? span : abs(value) / -range.z;
    isFree = isFree || reach >= span;
    bool isShort = span <= 1.5f * least;
    if (!isFree && !(range.w < 0.0f) && !isShort) {
      width = max(0.5f * span, least);
      if (reach < 0.25f * span || reach < least) continue;
      tNext = t + reach;
      next = fieldPlace(base, dir, tNext);
    } else {
      width = 2.0f * span;
      if (isFree && tNext >= within.y) return none;
    }
    float valueNext = fieldSlope(f, next, dir).x;
    if ((valueNext < 0.0f) != isInside) return vec2(t, tNext);
    if (tNext >= within.y) return none;
    t = tNext;
    at = next;
    value = valueNext;
  }
  RL_HEALTH(RL_HEALTH_SEGMENTS);
  float last = fieldSlope(f, fieldPlace(base, dir, within.y), dir).x;
  return (last < 0.0f) != isInside ? vec2(t, within.y) : none;
}

RL_FN_OUTLINE bool fieldIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  Field f = fieldOf(shape);
  vec2 inside = fieldClip(f, ray);
  float tBase = max(inside.x, 0.0f);
  if (!(tBase < inside.y)) return false;
  // From where the ray enters the box: lengths are small there, and so is their rounding.
  Ray fromBox = ray;
  fromBox.origin = ray.origin + ray.dir * tBase;
  inside = fieldClip(f, fromBox);
  vec2 within = vec2(max(inside.x, max(ray.tMin - tBase, 0.0f)), min(inside.y, ray.tMax - tBase));
  if (!(within.x < within.y)) return false;
  vec2 t = fieldSearch(f, fromBox.origin, ray.dir, within);
  if (!(t.x < t.y)) return false;
  vec2 low = fieldSlope(f, fieldPlace(fromBox.origin, ray.dir, t.x), ray.dir);
  vec2 high = fieldSlope(f, fieldPlace(fromBox.origin, ray.dir, t.y), ray.dir);
  t = fieldRefine(f, fromBox.origin, ray.dir, t, low, high);
  float tHit = tBase + t.y;
  // A ray that goes on begins at tHit - tBase: there, too, the sign must be that behind the hit.
  for (uint i = 0u; i < 8u; i = i + 1u) {
    float s = tHit - tBase;
    float value = fieldSlope(f, fieldPlace(fromBox.origin, ray.dir, s), ray.dir).x;
    if (s >= t.y && (value < 0.0f) == (high.x < 0.0f)) break;
    tHit = uintBitsToFloat(floatBitsToUint(tHit) + 1u);
  }
  if (!(tHit > ray.tMin) || !(tHit < ray.tMax)) return false;
  vec3 at = fieldPlace(fromBox.origin, ray.dir, t.y);
  vec2 end = fieldSlope(f, at, ray.dir);
  at = at - ray.dir * clamp(rlSafeDivide(end.x, end.y), 0.0f, t.y - t.x);
  hit.t = tHit;
  SurfaceId id = fieldId(f, at);
  hit.primitive = id.primitive;
  hit.bary = id.bary;
  return true;
}
