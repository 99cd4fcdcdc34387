// The square from (-1, -1) to (1, 1) in the plane z = 0, outside on +z. An id holds x and y.
// Textures: u along x, v along y.

RL_FN bool rectangleIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  float t = -ray.origin.z / ray.dir.z;
  if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
  vec2 at = vec2(ray.origin.x + t * ray.dir.x, ray.origin.y + t * ray.dir.y);
  if (!(abs(at.x) <= 1.0f) || !(abs(at.y) <= 1.0f)) return false;
  hit.t = t;
  hit.primitive = 0u;
  hit.bary = at * 0.5f + vec2(0.5f, 0.5f);
  return true;
}

RL_FN ShapePoint rectanglePoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  vec2 at = id.bary * 2.0f - vec2(1.0f, 1.0f);
  ShapePoint p = shapePointOn(vec3(at.x, at.y, 0.0f), vec3(0.0f, 0.0f, 1.0f));
  p.extent = vec3(1.0f, 1.0f, 0.0f);
  p.dpdu = vec3(2.0f, 0.0f, 0.0f);
  p.dpdv = vec3(0.0f, 2.0f, 0.0f);
  p.uv = id.bary;
  return p;
}

RL_FN SurfaceId rectangleDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = u;
  return id;
}

RL_FN float rectangleDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 0.25f;
}
