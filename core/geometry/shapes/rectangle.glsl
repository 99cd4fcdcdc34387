// The square from (-1, -1) to (1, 1) in the plane z = 0, outside on +z. An id holds x and y.
// Textures: u along x, v along y. Light samples: uniform in the solid angle of its own space.

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

// The square as a receiver at the origin sees it: edges at x0, x1 = x0 + 2, y0, y1 = y0 + 2, height
// z. What lies at x' < x has the solid angle rectangleAngle(x) - rectangleAngle(x0).
RL_FN float rectangleAngle(float x, float y0, float z) {
  float y1 = y0 + 2.0f;
  float across = x * x + z * z;
  float r0 = sqrt(across + y0 * y0) * z;
  float r1 = sqrt(across + y1 * y1) * z;
  return shapeAngleOf(vec2(r0 * r1 + x * x * y0 * y1, x * (y1 * r0 - y0 * r1)));
}

// Solid angle of the square, steradians. 0: it is so small, or so close, that light samples are
// uniform in area; differences of angles are too coarse there.
RL_FN float rectangleSolidAngle(RL_IN(vec3) receiverL) {
  float z = abs(receiverL.z);
  if (!(z > 1.0e-3f) || !(z < 8.0f)) return 0.0f;
  float x0 = -1.0f - receiverL.x;
  float y0 = -1.0f - receiverL.y;
  float angle = rectangleAngle(x0 + 2.0f, y0, z) - rectangleAngle(x0, y0, z);
  return angle > 0.03f ? angle : 0.0f;
}

// Uniform in solid angle, in two steps as Urena, Fajardo and King do ("An Area-Preserving
// Parametrization for Spherical Rectangles", 2013): x by the solid angle of what lies before it, y
// on the line at x. With cosines c0, c1 of the lower and upper edges' planes and the angle `turn` =
// rectangleAngle(x), the law of cosines gives x without an arc cosine.
RL_FN SurfaceId rectangleDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = u;
  float angle = rectangleSolidAngle(receiverL);
  if (!(angle > 0.0f)) return id;
  float z = abs(receiverL.z);
  float x0 = -1.0f - receiverL.x;
  float y0 = -1.0f - receiverL.y;
  float y1 = y0 + 2.0f;
  float turn = rectangleAngle(x0, y0, z) + u.x * angle;
  vec2 cosSin = rlCosSin2Pi(min(abs(turn) * (0.5f / RL_PI), 0.5f));
  float toEdge0 = y0 * y0 + z * z;
  float toEdge1 = y1 * y1 + z * z;
  float toBoth = 1.0f / sqrt(toEdge0 * toEdge1);
  float w = cosSin.x - y0 * y1 * toBoth;
  float m = z * z * toBoth;
  float x = z * cosSin.y / sqrt(max((w - m) * (w + m), 1.0e-12f));
  x = clamp(turn < 0.0f ? -x : x, x0, x0 + 2.0f);
  float across2 = x * x + z * z;
  float low = y0 / sqrt(across2 + y0 * y0);
  float high = y1 / sqrt(across2 + y1 * y1);
  float sine = low + u.y * (high - low);
  float y = sine * sqrt(across2 / max(1.0f - sine * sine, 1.0e-12f));
  y = clamp(y, y0, y1);
  id.bary = clamp(vec2(x - x0, y - y0) * 0.5f, vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
  return id;
}

RL_FN float rectangleDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  float angle = rectangleSolidAngle(receiverL);
  if (!(angle > 0.0f)) return 0.25f;
  vec3 d = point.posL - receiverL;
  float d2 = dot(d, d);
  return abs(receiverL.z) / (d2 * sqrt(d2) * angle);
}
