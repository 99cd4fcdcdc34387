// The unit sphere about the origin, poles on z. An id holds the octahedral map of the normal.
// Textures: u runs around z from x to y, v from the pole on +z down.

RL_FN bool sphereIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  // Begin at the point closest to the centre: the square of a far origin would swallow the radius
  // (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019).
  float dir2 = dot(ray.dir, ray.dir);
  float middle = -dot(ray.origin, ray.dir) / dir2;
  vec3 closest = ray.origin + ray.dir * middle;
  float left = 1.0f - dot(closest, closest);
  if (!(left >= 0.0f)) return false;
  float reach = sqrt(left / dir2);
  if (!(middle - reach > ray.tMin)) reach = -reach;
  float t = middle - reach;
  if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
  hit.t = t;
  hit.primitive = 0u;
  hit.bary = packOctahedron(closest - ray.dir * reach) * 0.5f + vec2(0.5f, 0.5f);
  return true;
}

RL_FN ShapePoint spherePoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  vec3 n = unpackOctahedron(id.bary.x * 2.0f - 1.0f, id.bary.y * 2.0f - 1.0f);
  ShapePoint p = shapePointOn(n, n);
  p.dpdu = vec3(-n.y, n.x, 0.0f);
  // At a pole any pair of directions will do.
  if (p.dpdu.x == 0.0f && p.dpdu.y == 0.0f) p.dpdu = vec3(0.0f, 1.0f, 0.0f);
  p.dpdv = cross(p.dpdu, n);
  p.uv = vec2(shapeTurn(vec2(n.x, n.y)),
              shapeAngle(n.z, sqrt(n.x * n.x + n.y * n.y)) * (1.0f / RL_PI));
  return p;
}

// 1 - cos of the cone in which a point outside sees the sphere; 2: the point is inside, or so close
// that float32 has no cone, and the whole area is drawn from.
RL_FN float sphereCone(RL_IN(vec3) receiverL) {
  float d2 = dot(receiverL, receiverL);
  if (!(d2 > 1.00001f)) return 2.0f;
  float sin2 = 1.0f / d2;
  return sin2 / (1.0f + sqrt(1.0f - sin2));
}

// Uniform in the solid angle that the receiver sees. The angle at the centre comes from the
// distance to the surface, not from cosines: near the sphere it is too small for 1 - cos.
RL_FN SurfaceId sphereDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  float cone = sphereCone(receiverL);
  vec2 around = rlCosSin2Pi(u.y);
  float below = cone * u.x;  // 1 - cos of the angle at the receiver, or about any axis
  float sine = sqrt(max(0.0f, below * (2.0f - below)));
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  vec3 n = vec3(around.x * sine, around.y * sine, 1.0f - below);
  if (cone < 2.0f) {
    float distance = sqrt(dot(receiverL, receiverL));
    float across = distance * sine;
    float toSurface = (distance - 1.0f) * (distance + 1.0f) /
                      (distance * (1.0f - below) + sqrt(max(0.0f, 1.0f - across * across)));
    float atCentre = min(toSurface * sine, 1.0f);
    n = frameToWorld(receiverL * (1.0f / distance),
                     vec3(around.x * atCentre, around.y * atCentre,
                          sqrt(max(0.0f, 1.0f - atCentre * atCentre))));
  }
  id.bary = packOctahedron(n) * 0.5f + vec2(0.5f, 0.5f);
  return id;
}

RL_FN float sphereDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  float cone = sphereCone(receiverL);
  if (!(cone < 2.0f)) return 1.0f / (4.0f * RL_PI);
  vec3 d = receiverL - point.posL;
  float d2 = dot(d, d);
  float cosine = dot(point.normalL, d);
  if (!(cosine > 0.0f)) return 0.0f;
  return cosine / (2.0f * RL_PI * cone * d2 * sqrt(d2));
}
