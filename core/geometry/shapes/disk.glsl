// The unit disk in the plane z = 0, outside on +z. An id holds x and y.
// Textures: u from the centre out, v around z from x to y. Light samples: nearly uniform in the
// solid angle of its own space.

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

// The cone in which a receiver sees the disk. The disk is an ellipse in it; around the axis that
// halves the angle between the nearest and the furthest point: (cosine, cosine, sine, sine) of half
// its opening towards them and across. Sum of the ways to both points: the second sine is 2 over
// it.
RL_FN vec4 diskCone(float away, float z) {
  float near2 = (away - 1.0f) * (away - 1.0f) + z * z;
  float far2 = (away + 1.0f) * (away + 1.0f) + z * z;
  float product = sqrt(near2) * sqrt(far2);
  float sum = sqrt(near2) + sqrt(far2);
  float cosine = ((away - 1.0f) * (away + 1.0f) + z * z) / product;  // of all the opening
  float sine = 2.0f * z / product;
  float larger = sqrt(0.5f + 0.5f * abs(cosine));
  float smaller = 0.5f * sine / larger;
  float c = cosine > 0.0f ? larger : smaller;
  float s = cosine > 0.0f ? smaller : larger;
  return vec4(c, 2.0f * sqrt(product) * c / sum, s, 2.0f / sum);
}

// Light samples are uniform in area where the disk is seen as flat as that, or as nothing.
RL_FN bool diskIsByArea(RL_IN(vec3) receiverL) {
  return !(abs(receiverL.z) > 1.0e-4f) || !(dot(receiverL, receiverL) < 1.0e6f);
}

// The direction from below the receiver to the middle of the disk.
RL_FN vec2 diskTowards(RL_IN(vec3) receiverL, float away) {
  if (!(away > 1.0e-12f)) return vec2(1.0f, 0.0f);
  return vec2(-receiverL.x, -receiverL.y) / away;
}

// Turns around the axis are counted by an angle x for which a direction at the rim is
// (sin a cos x, sin b sin x, cos t), a and b half the openings. Then cos^2 t = cos^2 a cos^2 x +
// cos^2 b sin^2 x, and the solid angle over dx is sin a sin b / (1 + cos t): it changes little.
RL_FN float diskRim(RL_IN(vec4) cone, float cosine2) {
  return sqrt(cone.x * cone.x * cosine2 + cone.y * cone.y * (1.0f - cosine2));
}

// That quotient at the ends of the quarters of a right angle. The density of x is linear between
// them.
RL_FN float diskWeight(RL_IN(vec4) cone, uint end) {
  float cosine2 = end == 0u   ? 1.0f
                  : end == 1u ? 0.853553391f
                  : end == 2u ? 0.5f
                  : end == 3u ? 0.146446609f
                              : 0.0f;
  return 1.0f / (1.0f + diskRim(cone, cosine2));
}

RL_FN float diskWeights(RL_IN(vec4) cone) {
  return 0.25f * (0.5f * (diskWeight(cone, 0u) + diskWeight(cone, 4u)) + diskWeight(cone, 1u) +
                  diskWeight(cone, 2u) + diskWeight(cone, 3u));
}

// A point uniform in area.
RL_FN SurfaceId diskAnywhere(RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = rlCosSin2Pi(u.y) * (0.5f * sqrt(u.x)) + vec2(0.5f, 0.5f);
  return id;
}

// Nearly uniform in solid angle: x, then the cosine to the axis between the rim's and 1.
RL_FN SurfaceId diskDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  if (diskIsByArea(receiverL)) return diskAnywhere(u);
  float z = abs(receiverL.z);
  float away = sqrt(receiverL.x * receiverL.x + receiverL.y * receiverL.y);
  vec4 cone = diskCone(away, z);
  float quadrant = min(floor(4.0f * u.y), 3.0f);
  float inQuadrant = 4.0f * u.y - quadrant;
  if (quadrant == 1.0f || quadrant == 3.0f) inQuadrant = 1.0f - inQuadrant;
  float rest = 4.0f * inQuadrant * diskWeights(cone);
  float low = diskWeight(cone, 0u);
  float high = diskWeight(cone, 1u);
  float part = 0.0f;
  for (uint i = 2u; i < 5u; i = i + 1u) {
    float whole = 0.5f * (low + high);
    if (rest < whole) break;
    rest = rest - whole;
    part = part + 1.0f;
    low = high;
    high = diskWeight(cone, i);
  }
  float within = 2.0f * rest / (low + sqrt(max(low * low + 2.0f * (high - low) * rest, 0.0f)));
  vec2 turn = rlCosSin2Pi((part + min(within, 1.0f)) * 0.0625f);
  if (quadrant == 1.0f || quadrant == 2.0f) turn.x = -turn.x;
  if (quadrant >= 2.0f) turn.y = -turn.y;
  float rim = diskRim(cone, turn.x * turn.x);
  float share = u.x / (1.0f + rim);
  float cosine = rim + (1.0f - u.x) * (1.0f - rim);
  // The sine to the axis over that of the rim.
  float outwards = sqrt(share * (1.0f + cosine));
  float toAxis = cone.y * sqrt(z / (cone.x * cone.z));  // from the receiver to the axis' end
  float along = outwards * cone.z * turn.x;
  float across = outwards * cone.w * turn.y;
  float down = (z * cosine - away * cone.y * cone.y * along) / toAxis;
  vec2 at = vec2(toAxis * along / down - away * cone.w * cone.w, z * across / down);
  vec2 towards = diskTowards(receiverL, away);
  at = vec2(at.x * towards.x - at.y * towards.y, at.x * towards.y + at.y * towards.x);
  at = at / max(sqrt(dot(at, at)), 1.0f);  // rounding has put it beyond the rim
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = at * 0.5f + vec2(0.5f, 0.5f);
  return id;
}

RL_FN float diskDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  if (diskIsByArea(receiverL)) return 1.0f / RL_PI;
  float z = abs(receiverL.z);
  float away = sqrt(receiverL.x * receiverL.x + receiverL.y * receiverL.y);
  vec4 cone = diskCone(away, z);
  vec2 towards = diskTowards(receiverL, away);
  vec2 at = vec2(dot(vec2(point.posL.x, point.posL.y), towards),
                 towards.x * point.posL.y - towards.y * point.posL.x);
  // Coordinates of the point across the axis, over the sines of the openings.
  float toAxis = cone.y * sqrt(z / (cone.x * cone.z));
  vec2 turn = vec2(abs(at.x + away * cone.w * cone.w) * z / (toAxis * cone.z), abs(at.y) / cone.w);
  float place = shapeAngleOf(turn) * (8.0f / RL_PI);
  uint part = min(uint(place), 3u);
  float low = diskWeight(cone, part);
  float high = diskWeight(cone, part + 1u);
  float weight = low + (high - low) * (place - float(part));
  float size2 = dot(turn, turn);
  float rim = diskRim(cone, size2 > 0.0f ? turn.x * turn.x / size2 : 1.0f);
  vec3 d = point.posL - receiverL;
  float d2 = dot(d, d);
  return weight * (1.0f + rim) * z /
         (2.0f * RL_PI * cone.z * cone.w * diskWeights(cone) * d2 * sqrt(d2));
}
