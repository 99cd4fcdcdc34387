// The torus about z: its tube, of radius `minor`, runs along the unit circle in the plane z = 0.
// Parameter: x is the tube's radius, in (0, 1). An id holds two places on circles: around z and
// around the tube, from the outside up.
// Textures: u runs around z from x to y, v around the tube from its outside up.

RL_FN float torusMinor(RL_IN(Shape) shape) {
  return uintBitsToFloat(RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord).x);
}

// (distance to the unit circle)^2 - r^2, and its derivative along a direction.
RL_FN vec2 torusSide(RL_IN(vec3) at, RL_IN(vec3) dir, float r) {
  float rho = sqrt(at.x * at.x + at.y * at.y);
  float fromCircle = rho - 1.0f;
  float distance2 = fromCircle * fromCircle + at.z * at.z;
  float slope = rlSafeDivide(at.x * dir.x + at.y * dir.y, rho) * fromCircle + at.z * dir.z;
  return vec2(distance2 - r * r, 2.0f * slope);
}

// Root of the cubic 4 s^3 + 2 q s + e in [low, high], where it is monotone and changes its sign.
RL_FN float torusExtremum(float q, float e, float low, float high) {
  bool rises = high * (4.0f * high * high + 2.0f * q) + e > 0.0f;
  float a = low;
  float b = high;
  float s = 0.5f * (a + b);
  for (uint i = 0u; i < 40u; i = i + 1u) {
    float value = s * (4.0f * s * s + 2.0f * q) + e;
    if ((value > 0.0f) == rises) {
      b = s;
    } else {
      a = s;
    }
    float next = s - value / (12.0f * s * s + 2.0f * q);
    if (!(next > a && next < b)) next = 0.5f * (a + b);
    bool isDone = abs(next - s) <= 1.0e-7f;
    s = next;
    if (isDone) break;
  }
  return s;
}

// Root between low and high, on different sides of the surface: o + s dir.
RL_FN float torusRoot(RL_IN(vec3) o, RL_IN(vec3) dir, float r, float low, float high,
                      bool isInside) {
  float a = low;
  float b = high;
  float s = 0.5f * (a + b);
  for (uint i = 0u; i < 48u; i = i + 1u) {
    vec2 side = torusSide(o + dir * s, dir, r);
    if ((side.x < 0.0f) == isInside) {
      a = s;
    } else {
      b = s;
    }
    float next = s - side.x / side.y;
    if (!(next > a && next < b)) next = 0.5f * (a + b);
    bool isDone = abs(next - s) <= 6.0e-8f;
    s = next;
    if (isDone) break;
  }
  return s;
}

// The sign of the quartic of the ray decides, between places where the quartic turns: so no root is
// missed, and two that coincide are found or passed over together. The side of the origin is taken
// from the origin itself: a ray that has left the surface does not meet it at once.
RL_FN bool torusIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  float r = torusMinor(shape);
  float speed = sqrt(dot(ray.dir, ray.dir));
  vec3 dir = ray.dir * (1.0f / speed);
  // Begin at the point closest to the centre: the quartic then has no cubic term.
  float middle = -dot(ray.origin, dir);
  vec3 o = ray.origin + dir * middle;
  float rest = dot(o, dir);
  o = o - dir * rest;
  middle = middle - rest;
  // In the ball around the torus, and between the planes that touch it; a little more.
  float reach2 = (1.0f + r) * (1.0f + r) + 1.0e-5f - dot(o, o);
  if (!(reach2 > 0.0f)) return false;
  float reach = sqrt(reach2);
  float begin = max(-reach, ray.tMin * speed - middle);
  float end = min(reach, ray.tMax * speed - middle);
  if (dir.z != 0.0f) {
    float inverse = 1.0f / dir.z;
    float thick = r + 1.0e-5f;
    begin = max(begin, min((-thick - o.z) * inverse, (thick - o.z) * inverse));
    end = min(end, max((-thick - o.z) * inverse, (thick - o.z) * inverse));
  } else if (abs(o.z) > r) {
    return false;
  }
  if (!(begin < end)) return false;
  // s^4 + q s^2 + e s + ...
  float k = dot(o, o) + 1.0f - r * r;
  float q = 2.0f * k - 4.0f * (dir.x * dir.x + dir.y * dir.y);
  float e = -8.0f * (o.x * dir.x + o.y * dir.y);
  float bend = q < 0.0f ? sqrt(q * (-1.0f / 6.0f)) : 0.0f;  // the quartic's curvature changes here
  float tolerance = 1.0e-6f * r;                            // rounding of torusSide()
  vec2 start = torusSide(ray.origin + ray.dir * ray.tMin, dir, r);
  // A ray that goes on from the surface is on the side to which it goes.
  float slack = 1.0e-6f * r * (1.0f + sqrt(dot(ray.origin, ray.origin)));
  bool goesOn = ray.tMin > 0.0f && abs(start.x) < slack;
  bool isInside = (goesOn ? start.y : start.x) < 0.0f;
  if (begin > ray.tMin * speed - middle) isInside = false;
  float low = begin;
  for (uint piece = 0u; piece < 3u; piece = piece + 1u) {
    float high = piece == 0u ? -bend : piece == 1u ? bend : end;
    high = min(high, end);
    if (!(high > low)) continue;
    // The slope is monotone in [low, high].
    float slopeLow = low * (4.0f * low * low + 2.0f * q) + e;
    float slopeHigh = high * (4.0f * high * high + 2.0f * q) + e;
    bool turns = (slopeLow > 0.0f) != (slopeHigh > 0.0f);
    for (uint part = 0u; part < 2u; part = part + 1u) {
      if (part == 0u && !turns) continue;
      float to = part == 0u ? torusExtremum(q, e, low, high) : high;
      float value = torusSide(o + dir * to, dir, r).x;
      if (isInside ? value > tolerance : value < -tolerance) {
        float s = torusRoot(o, dir, r, low, to, isInside);
        float t = (middle + s) / speed;
        if (!(t > ray.tMin) || !(t < ray.tMax)) return false;
        vec3 at = o + dir * s;
        float rho = sqrt(at.x * at.x + at.y * at.y);
        hit.t = t;
        hit.primitive = 0u;
        hit.bary = vec2(shapeDiamond(vec2(at.x, at.y)), shapeDiamond(vec2(rho - 1.0f, at.z)));
        return true;
      }
      low = to;
    }
  }
  return false;
}

RL_FN ShapePoint torusPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  float r = torusMinor(shape);
  vec2 around = shapeFromDiamond(id.bary.x);
  vec2 tube = shapeFromDiamond(id.bary.y);
  float rho = 1.0f + r * tube.x;
  ShapePoint p = shapePointOn(vec3(around.x * rho, around.y * rho, r * tube.y),
                              vec3(around.x * tube.x, around.y * tube.x, tube.y));
  p.extent = vec3(1.0f + r, 1.0f + r, r);
  p.dpdu = vec3(-around.y, around.x, 0.0f);
  p.dpdv = vec3(-around.x * tube.y, -around.y * tube.y, tube.x);
  p.uv = vec2(shapeTurn(around), shapeTurn(tube));
  return p;
}

// Uniform in area: the outside of the tube is longer than its inside. A place on the tube that is
// drawn too often is mirrored to the outside; the number that decides is used up by this alone.
RL_FN SurfaceId torusDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  vec2 tube = rlCosSin2Pi(u.y);
  float keep = 0.5f + 0.5f * torusMinor(shape) * tube.x;
  bool isKept = u.x < keep;
  float turn = isKept ? u.x / keep : (u.x - keep) / (1.0f - keep);
  if (!isKept) tube.x = -tube.x;
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = vec2(shapeDiamond(rlCosSin2Pi(min(turn, 0.99999994f))), shapeDiamond(tube));
  return id;
}

RL_FN float torusDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 1.0f / (4.0f * RL_PI * RL_PI * torusMinor(shape));
}
