// The unit disk in the plane z = 0, outside on +z. An id holds x and y.
// Textures: u from the centre out, v around z from x to y.

RL_FN bool diskIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  float t = -ray.origin.z / ray.dir.z;
  if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
  vec2 at = vec2(ray.origin.x + t * ray.dir.x, ray.origin.y + t * ray.dir.y);
  if (!(dot(at, at) <= 1.0f)) return false;
  hit.t = t;
  hit.primitive = 0u;
  hit.bary = at * 0.5f + vec2(0.5f, 0.5f);
  return true;
}

RL_FN ShapePoint diskPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  vec2 at = id.bary * 2.0f - vec2(1.0f, 1.0f);
  ShapePoint p = shapePointOn(vec3(at.x, at.y, 0.0f), vec3(0.0f, 0.0f, 1.0f));
  p.extent = vec3(1.0f, 1.0f, 0.0f);
  p.dpdu = vec3(at.x, at.y, 0.0f);
  p.dpdv = vec3(-at.y, at.x, 0.0f);
  if (at.x == 0.0f && at.y == 0.0f) {
    p.dpdu = vec3(1.0f, 0.0f, 0.0f);
    p.dpdv = vec3(0.0f, 1.0f, 0.0f);
  }
  p.uv = vec2(sqrt(dot(at, at)), shapeTurn(at));
  return p;
}

RL_FN SurfaceId diskDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = rlCosSin2Pi(u.y) * (0.5f * sqrt(u.x)) + vec2(0.5f, 0.5f);
  return id;
}

RL_FN float diskDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 1.0f / RL_PI;
}
