// The cube from (-1, -1, -1) to (1, 1, 1). An id holds the face (primitive: 0 and 1 x = -1 and 1,
// 2 and 3 y, 4 and 5 z) and its coordinates along the next two axes.
// Textures: each face has its own axes (cubeTextureAxis), those of Mitsuba's cube.

// A vector with the coordinates (along the axis of a face, along the next, along the one after).
RL_FN vec3 cubeAxes(uint axis, RL_IN(vec3) v) {
  if (axis == 0u) return v;
  if (axis == 1u) return vec3(v.z, v.x, v.y);
  return vec3(v.y, v.z, v.x);
}

RL_FN bool cubeIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  // The last of the planes that the ray meets from outside, the first of those from inside.
  float enter = -3.0e38f;
  float leave = 3.0e38f;
  uint enterFace = 0u;
  uint leaveFace = 0u;
  for (uint axis = 0u; axis < 3u; axis = axis + 1u) {
    float o = axis == 0u ? ray.origin.x : axis == 1u ? ray.origin.y : ray.origin.z;
    float d = axis == 0u ? ray.dir.x : axis == 1u ? ray.dir.y : ray.dir.z;
    if (d == 0.0f) {
      if (abs(o) > 1.0f) return false;
      continue;
    }
    float inverse = 1.0f / d;
    float a = (-1.0f - o) * inverse;
    float b = (1.0f - o) * inverse;
    uint low = 2u * axis;
    bool isAlong = d > 0.0f;
    if (min(a, b) > enter) {
      enter = min(a, b);
      enterFace = isAlong ? low : low + 1u;
    }
    if (max(a, b) < leave) {
      leave = max(a, b);
      leaveFace = isAlong ? low + 1u : low;
    }
  }
  if (!(enter <= leave)) return false;
  bool enters = enter > ray.tMin;
  float t = enters ? enter : leave;
  if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
  uint face = enters ? enterFace : leaveFace;
  vec3 at = ray.origin + ray.dir * t;
  uint axis = face / 2u;
  vec2 onFace = axis == 0u ? vec2(at.y, at.z) : axis == 1u ? vec2(at.z, at.x) : vec2(at.x, at.y);
  hit.t = t;
  hit.primitive = face;
  hit.bary = clamp(onFace * 0.5f + vec2(0.5f, 0.5f), vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
  return true;
}

// Unit vector along u (0) or v (1) of a face.
RL_FN vec3 cubeTextureAxis(uint face, uint which) {
  vec3 x = vec3(1.0f, 0.0f, 0.0f);
  vec3 y = vec3(0.0f, 1.0f, 0.0f);
  vec3 z = vec3(0.0f, 0.0f, 1.0f);
  if (face == 0u) return which == 0u ? y : z;
  if (face == 1u) return which == 0u ? y : -z;
  if (face == 2u) return which == 0u ? z : x;
  if (face == 3u) return which == 0u ? -x : -z;
  if (face == 4u) return which == 0u ? -y : x;
  return which == 0u ? y : x;
}

RL_FN ShapePoint cubePoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  uint axis = id.primitive / 2u;
  float side = (id.primitive & 1u) != 0u ? 1.0f : -1.0f;
  vec2 at = id.bary * 2.0f - vec2(1.0f, 1.0f);
  ShapePoint p =
      shapePointOn(cubeAxes(axis, vec3(side, at.x, at.y)), cubeAxes(axis, vec3(side, 0.0f, 0.0f)));
  p.extent = vec3(1.0f, 1.0f, 1.0f);
  p.dpdu = cubeTextureAxis(id.primitive, 0u) * 2.0f;
  p.dpdv = cubeTextureAxis(id.primitive, 1u) * 2.0f;
  p.uv = vec2(dot(p.posL, p.dpdu), dot(p.posL, p.dpdv)) * 0.25f + vec2(0.5f, 0.5f);
  return p;
}

RL_FN SurfaceId cubeDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  float x = min(u.x * 6.0f, 5.999999f);
  id.primitive = uint(x);
  id.bary = vec2(x - float(id.primitive), u.y);
  return id;
}

RL_FN float cubeDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 1.0f / 24.0f;
}
