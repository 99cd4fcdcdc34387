// The plane z = 0 out to |x| and |y| = `size`, outside on +z. Parameter: x is the size.
// An id holds x and y, close together near the origin and apart in proportion to the distance: of
// 24 bits each, 1 + |x| keeps a part in 200,000 or more. The bound of errors grows likewise: it is
// that of the point, not of the whole plane.
// Textures: u along x, v along y, one repeat a metre of its own space.

RL_FN float planeSize(RL_IN(Shape) shape) {
  return uintBitsToFloat(RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord).x);
}

// The bits of a float are its logarithm, but for straight lines between powers of 2: monotone, and
// the same on every machine.
RL_FN float planeLog(float x) { return float(floatBitsToUint(1.0f + abs(x)) - 0x3f800000u); }

RL_FN float planeCoordinate(float x, float size) {
  float part = min(planeLog(x) / planeLog(size), 1.0f);
  return 0.5f + (x < 0.0f ? -0.5f : 0.5f) * part;
}
RL_FN float planeFromCoordinate(float coordinate, float size) {
  float part = abs(coordinate * 2.0f - 1.0f);
  float x = uintBitsToFloat(uint(part * planeLog(size)) + 0x3f800000u) - 1.0f;
  return coordinate < 0.5f ? -x : x;
}

RL_FN bool planeIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  float t = -ray.origin.z / ray.dir.z;
  if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
  float size = planeSize(shape);
  vec2 at = vec2(ray.origin.x + t * ray.dir.x, ray.origin.y + t * ray.dir.y);
  if (!(abs(at.x) <= size) || !(abs(at.y) <= size)) return false;
  hit.t = t;
  hit.primitive = 0u;
  hit.bary = vec2(planeCoordinate(at.x, size), planeCoordinate(at.y, size));
  return true;
}

RL_FN ShapePoint planePoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  float size = planeSize(shape);
  vec2 at = vec2(planeFromCoordinate(id.bary.x, size), planeFromCoordinate(id.bary.y, size));
  ShapePoint p = shapePointOn(vec3(at.x, at.y, 0.0f), vec3(0.0f, 0.0f, 1.0f));
  p.extent = vec3(1.0f + abs(at.x), 1.0f + abs(at.y), 0.0f);
  p.uv = at;
  return p;
}

// Planes have no light samples.
RL_FN SurfaceId planeDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  return surfaceIdNone();
}
RL_FN float planeDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 0.0f;
}
