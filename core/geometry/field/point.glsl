// Points of a field's surface. An id holds the axis along which the field is steepest (2 bits of
// the primitive), the place along it in the box (30 bits), and the places along the next two axes
// (bary). A point begins there and goes along the axis to where the field is 0.

RL_FN float fieldAlong(RL_IN(vec3) v, uint axis) {
  return axis == 0u ? v.x : axis == 1u ? v.y : v.z;
}

// A vector with the coordinates (along an axis, along the next, along the one after).
RL_FN vec3 fieldTurned(uint axis, RL_IN(vec3) v) {
  if (axis == 0u) return v;
  if (axis == 1u) return vec3(v.z, v.x, v.y);
  return vec3(v.y, v.z, v.x);
}

RL_FN SurfaceId fieldId(RL_IN(Field) f, RL_IN(vec3) at) {
  vec3 slope = abs(fieldGradient(f, at));
  uint axis = slope.x >= max(slope.y, slope.z) ? 0u : slope.y >= slope.z ? 1u : 2u;
  vec3 inBox =
      clamp((at - f.low) / (f.high - f.low), vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
  uint along = min(uint(fieldAlong(inBox, axis) * 1073741824.0f), 0x3fffffffu);
  SurfaceId id = surfaceIdNone();
  id.primitive = (axis << 30u) | along;
  id.bary = vec2(fieldAlong(inBox, axis == 2u ? 0u : axis + 1u),
                 fieldAlong(inBox, axis == 0u ? 2u : axis - 1u));
  return id;
}

RL_FN_OUTLINE ShapePoint fieldPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  Field f = fieldOf(shape);
  vec3 size = f.high - f.low;
  uint axis = min(id.primitive >> 30u, 2u);
  float along = (float(id.primitive & 0x3fffffffu) + 0.5f) * (1.0f / 1073741824.0f);
  vec3 at = f.low + size * fieldTurned(axis, vec3(along, id.bary.x, id.bary.y));
  vec3 unit = fieldAxis(axis);
  // The id is right to a few units in the last place: larger steps are those of a field that is
  // flat there.
  float most = fieldAlong(size, axis) * 3.0e-5f;
  for (uint i = 0u; i < 3u; i = i + 1u) {
    vec2 value = fieldSlope(f, at, unit);
    at = at - unit * clamp(rlSafeDivide(value.x, value.y), -most, most);
  }
  at = clamp(at, f.low, f.high);
  vec3 slope = fieldGradient(f, at);
  float slope2 = dot(slope, slope);
  bool isSingular = !(slope2 > 1.0e-30f);
  float inverse = isSingular ? 0.0f : 1.0f / sqrt(slope2);
  ShapePoint p = shapePointOn(at, isSingular ? vec3(0.0f, 0.0f, 1.0f) : slope * inverse);
  // Error across the surface: what rounding may do to the value, over the slope. A thousandth of
  // the box is the most that a ray is moved by.
  vec4 range = fieldRange(f, at, at, vec3(0.0f, 0.0f, 0.0f));
  float most3 = 1.0e-3f * rlMax3(size);
  float error = isSingular ? most3 : min(3.0f * max(-range.x, range.y) * inverse, most3);
  float widest = rlMax3(max(abs(f.low), abs(f.high))) + error / RL_HIT_ERROR;
  p.extent = vec3(widest, widest, widest);
  vec3 n = p.normalL;
  vec3 toPoint = at - 0.5f * (f.low + f.high);
  vec3 around = vec3(-toPoint.y, toPoint.x, 0.0f);
  around = around - n * dot(around, n);
  if (!(dot(around, around) > 1.0e-6f * dot(toPoint, toPoint)) || rlIsBlack(toPoint)) {
    vec3 other;
    frameFromNormal(n, around, other);
  }
  around = around - n * dot(around, n);  // what rounding has left
  p.dpdu = around;
  p.dpdv = cross(around, n);
  p.uv = vec2(
      shapeTurn(vec2(toPoint.x, toPoint.y)),
      shapeAngle(toPoint.z, sqrt(toPoint.x * toPoint.x + toPoint.y * toPoint.y)) * (1.0f / RL_PI));
  return p;
}
