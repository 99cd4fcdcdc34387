// Strands with radii: the union of round cones, hulls of two spheres that
// follow each other (core/scene/curves/curve_words.h says what the words are).
// An id holds the piece, the place around its axis and the place along it: a
// quarter for each end, the side between them. Textures: u runs around the
// strand, v along it.

RL_FN CurvePiece curvesPiece(RL_IN(Shape) shape, uint piece) {
  CurvePiece p;
  uint pieces = RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord).y;
  p.first = shape.firstWord + pieces + 3u * piece;
  vec4 start = shapeVec4(p.first);
  vec4 end = shapeVec4(p.first + 1u);
  vec3 along = vec3(end) - vec3(start);
  p.start = vec3(start);
  p.startRadius = start.w;
  p.endRadius = end.w;
  p.axisLength = sqrt(dot(along, along));
  // A piece without a length is a sphere: any axis will do.
  p.axis = p.axisLength > 0.0f ? along * (1.0f / p.axisLength) : vec3(0.0f, 0.0f, 1.0f);
  p.sine = rlSafeDivide(start.w - end.w, p.axisLength);
  p.cosine = sqrt(max((1.0f - p.sine) * (1.0f + p.sine), 0.0f));
  return p;
}

// Adds the two points of a line on the sphere about the origin to a span of
// distances from `base`.
RL_FN void curvesAddSphere(RL_IN(vec3) base, RL_IN(vec3) dir, float radius, RL_INOUT(vec2) span) {
  float middle = -dot(base, dir);
  vec3 closest = base + dir * middle;
  float left = radius * radius - dot(closest, closest);
  if (!(left > 0.0f)) return;
  float reach = sqrt(left);
  span = vec2(min(span.x, middle - reach), max(span.y, middle + reach));
}

// Adds the points of a line on the side, the cone that touches both spheres: c
// rho = r - s y, with y along the axis and rho away from it. Beyond the circles
// where it touches it is closer to the spheres than float32 can tell, for a
// thousandth of their radius: none slips through in between.
RL_FN void curvesAddSide(RL_IN(CurvePiece) p, RL_IN(vec3) base, RL_IN(vec3) dir,
                         RL_INOUT(vec2) span) {
  float dirAxis = dot(dir, p.axis);
  vec3 dirAway = dir - p.axis * dirAxis;
  float away2 = dot(dirAway, dirAway);
  float y = dot(base, p.axis);
  vec3 away = base - p.axis * y;
  // From the point closest to the axis: squares of far points would swallow the
  // radius. A line that is nearly along the side has it far away, and is looked
  // at from an end of the piece.
  float reach = 0.5f * p.axisLength + max(p.startRadius, p.endRadius);
  float toAxis = rlSafeDivide(-dot(away, dirAway), away2);
  float middle = clamp(toAxis, -reach, reach);
  y = y + middle * dirAxis;
  away = away + dirAway * middle;
  float radius = p.startRadius - p.sine * y;  // times the cosine it is that of the cone
  float distance2 = dot(away, away);
  float outer = p.cosine * sqrt(distance2);
  float fall = p.sine * dirAxis;
  // a t^2 + 2 b t + c = 0. The quarter of its discriminant is b^2 - a c; at the
  // point closest to the axis two large terms of it cancel, and are left out.
  float cosine2 = p.cosine * p.cosine;
  float a = cosine2 * away2 - fall * fall;
  float b = fall * radius;
  float c = (outer - radius) * (outer + radius);
  float root = cosine2 * (away2 * (radius - outer) * (radius + outer) + fall * fall * distance2);
  if (middle != toAxis) {
    b = b + cosine2 * dot(away, dirAway);
    root = b * b - a * c;
  }
  if (!(root >= 0.0f)) return;
  float q = -(b + (b < 0.0f ? -sqrt(root) : sqrt(root)));
  float low = (p.sine - 1.0e-3f * p.cosine) * p.startRadius;
  float high = p.axisLength + (p.sine + 1.0e-3f * p.cosine) * p.endRadius;
  for (uint i = 0u; i < 2u; i = i + 1u) {
    float t = i == 0u ? q / a : c / q;
    float at = y + t * dirAxis;
    if (!(at >= low) || !(at <= high)) continue;
    span = vec2(min(span.x, middle + t), max(span.y, middle + t));
  }
}

// Span of a line inside a piece, as distances along dir (unit) from `origin`;
// none: x is above y. It does not depend on where the ray begins to look, so
// that a ray that goes on finds the same.
RL_FN vec2 curvesSpan(RL_IN(CurvePiece) p, RL_IN(vec3) origin, RL_IN(vec3) dir) {
  vec3 middle = p.axis * (0.5f * p.axisLength);
  vec3 base = origin - p.start;
  float nearest = dot(middle - base, dir);
  base = base + dir * nearest;
  vec2 span = vec2(3.0e38f, -3.0e38f);
  vec3 beside = base - middle;
  float reach = 0.5f * p.axisLength + max(p.startRadius, p.endRadius);
  if (dot(beside, beside) > 1.0001f * reach * reach) return span;
  curvesAddSphere(base, dir, p.startRadius, span);
  curvesAddSphere(base - p.axis * p.axisLength, dir, p.endRadius, span);
  curvesAddSide(p, base, dir, span);
  return span.x < span.y ? span + vec2(nearest, nearest) : span;
}

// Where u begins: unit, away from the axis.
RL_FN vec3 curvesReference(RL_IN(CurvePiece) p) {
  vec4 marks = shapeVec4(p.first + 2u);
  vec3 x = unpackOctahedron(marks.x, marks.y);
  return normalize(x - p.axis * dot(x, p.axis));
}

// Coordinates of the point of a piece that is at `at`, relative to its start.
RL_FN vec2 curvesCoordinates(RL_IN(CurvePiece) p, RL_IN(vec3) at) {
  vec3 x = curvesReference(p);
  float y = dot(at, p.axis);
  vec3 away = at - p.axis * y;
  float turn = shapeDiamond(vec2(dot(away, x), dot(away, cross(p.axis, x))));
  float low = p.sine * p.startRadius;
  float high = p.axisLength + p.sine * p.endRadius;
  if (y >= low && y <= high)
    return vec2(turn, 0.25f + 0.5f * min(rlSafeDivide(y - low, high - low), 1.0f));
  // On a sphere: the tangent of half the angle from the pole, over that of the
  // rim.
  bool isStart = y < low;
  vec3 fromCentre = isStart ? at : at - p.axis * p.axisLength;
  float up = isStart ? -y : y - p.axisLength;
  float tangent = rlSafeDivide(sqrt(dot(away, away)), sqrt(dot(fromCentre, fromCentre)) + up);
  float share = tangent * p.cosine / (isStart ? 1.0f + p.sine : 1.0f - p.sine);
  return vec2(turn, isStart ? 0.25f * min(share, 1.0f) : 1.0f - 0.25f * min(share, 1.0f));
}

// Signed distance to a piece, below 0 inside.
RL_FN float curvesDistance(RL_IN(CurvePiece) p, RL_IN(vec3) posL) {
  vec3 at = posL - p.start;
  float y = dot(at, p.axis);
  vec3 away = at - p.axis * y;
  float rho = sqrt(dot(away, away));
  float foot = y * p.cosine - rho * p.sine;  // of the normal, on the axis, times the cosine
  if (foot <= 0.0f) return sqrt(dot(at, at)) - p.startRadius;
  if (foot < p.axisLength * p.cosine) return y * p.sine + rho * p.cosine - p.startRadius;
  vec3 fromEnd = at - p.axis * p.axisLength;
  return sqrt(dot(fromEnd, fromEnd)) - p.endRadius;
}

// The piece on whose surface a point of the union lies: the one that it is
// deepest in. Rays from afar may find its neighbour first, by rounding, and a
// point of that could be within the union.
RL_FN uint curvesOwner(RL_IN(Shape) shape, RL_IN(vec3) posL, uint found) {
  uint nodes = shape.firstWord;
  uint leaves = RL_SCENE_UVEC4(gScene.shapeWords, nodes).x;
  uint owner = found;
  float least = curvesDistance(curvesPiece(shape, found), posL);
  uint node = 1u;
  uint waiting = 0u;
  bool goesOn = true;
  while (goesOn) {
    vec3 low = vec3(shapeVec4(nodes + 2u * node));
    vec3 high = vec3(shapeVec4(nodes + 2u * node + 1u));
    bool holds = posL.x >= low.x && posL.y >= low.y && posL.z >= low.z && posL.x <= high.x &&
                 posL.y <= high.y && posL.z <= high.z;
    if (holds && node < leaves) {
      node = 2u * node;
      waiting = waiting * 2u + 1u;
      continue;
    }
    if (holds) {
      uint piece = RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node).w;
      uint end = RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node + 1u).w;
      for (; piece < end; piece = piece + 1u) {
        float distance = curvesDistance(curvesPiece(shape, piece), posL);
        if (distance < least) {
          least = distance;
          owner = piece;
        }
      }
    }
    goesOn = waiting != 0u;
    while (waiting != 0u && (waiting & 1u) == 0u) {
      waiting = waiting / 2u;
      node = node / 2u;
    }
    if (goesOn) {
      waiting = waiting - 1u;
      node = node + 1u;
    }
  }
  return owner;
}

// Finds the first point of the union of all pieces. A ray that begins outside
// meets the piece that it enters first. One that begins in a piece is inside
// until it leaves a piece and is in no other: no surface within another piece
// is met, and none slips through where pieces join.
RL_FN bool curvesIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  uint nodes = shape.firstWord;  // node k begins at nodes + 2 k; those of k = 0
                                 // are the head
  uint leaves = RL_SCENE_UVEC4(gScene.shapeWords, nodes).x;  // nodes from this number on
  float size = sqrt(dot(ray.dir, ray.dir));
  vec3 dir = ray.dir * (1.0f / size);
  vec3 inverse = shapeInverse(ray.dir);
  float nearest = ray.tMax;  // where a piece is entered
  float inside = ray.tMin;   // so far no way leads out
  bool isInside = false;
  bool grew = false;  // `inside` did, since the root
  uint owner = RL_INVALID;
  uint node = 1u;
  uint waiting = 0u;  // the bits say on which levels the sibling waits
  bool goesOn = true;
  while (goesOn) {
    // Inside, only pieces around one place count; boxes know it to a few units
    // in the last place.
    float tMin = isInside ? inside : ray.tMin;
    float tMax = isInside ? inside * 1.000001f : nearest;
    bool isDone = true;  // with this node and all below
    if (shapeEnterBox(nodes + 2u * node, ray.origin, inverse, tMin, tMax) < 3.0e38f) {
      if (node < leaves) {
        uint child = 2u * node;
        float low = shapeEnterBox(nodes + 2u * child, ray.origin, inverse, tMin, tMax);
        float high = shapeEnterBox(nodes + 2u * child + 2u, ray.origin, inverse, tMin, tMax);
        if (min(low, high) < 3.0e38f) {
          node = high < low ? child + 1u : child;
          waiting = waiting * 2u + (max(low, high) < 3.0e38f ? 1u : 0u);
          isDone = false;
        }
      } else {
        uint piece = RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node).w;
        uint end = RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node + 1u).w;
        for (; piece < end; piece = piece + 1u) {
          vec2 span = curvesSpan(curvesPiece(shape, piece), ray.origin, dir) * (1.0f / size);
          if (!(span.x < span.y)) continue;
          if (span.x <= inside && inside < span.y) {
            inside = span.y;
            isInside = true;
            grew = true;
            owner = piece;
          } else if (!isInside && span.x > inside && span.x < nearest) {
            nearest = span.x;
            owner = piece;
          }
        }
      }
    }
    if (isDone) {
      goesOn = waiting != 0u;
      while (waiting != 0u && (waiting & 1u) == 0u) {
        waiting = waiting / 2u;
        node = node / 2u;
      }
      if (goesOn) {
        waiting = waiting - 1u;
        node = (node / 2u) * 2u + 1u - (node & 1u);
      } else if (grew && inside < ray.tMax) {
        goesOn = true;
        grew = false;
        node = 1u;
      }
    }
  }
  if (owner == RL_INVALID || (isInside && !(inside < ray.tMax))) return false;
  CurvePiece p = curvesPiece(shape, owner);
  vec2 span = curvesSpan(p, ray.origin, dir);
  vec3 at = (ray.origin - p.start) + dir * (isInside ? span.y : span.x);
  uint outermost = curvesOwner(shape, p.start + at, owner);
  if (outermost != owner) {
    CurvePiece other = curvesPiece(shape, outermost);
    at = at + (p.start - other.start);
    p = other;
  }
  hit.t = isInside ? inside : nearest;
  hit.primitive = outermost;
  hit.bary = curvesCoordinates(p, at);
  return true;
}

RL_FN ShapePoint curvesPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  CurvePiece p = curvesPiece(shape, id.primitive);
  vec4 marks = shapeVec4(p.first + 2u);
  vec3 x = curvesReference(p);
  vec2 around = shapeFromDiamond(id.bary.x);
  vec3 away = x * around.x + cross(p.axis, x) * around.y;
  bool isStart = id.bary.y < 0.25f;
  bool isEnd = id.bary.y > 0.75f;
  float share = isEnd ? 1.0f : isStart ? 0.0f : 2.0f * id.bary.y - 0.5f;
  float up = p.sine;
  float off = p.cosine;
  if (isStart || isEnd) {
    float tangent = (isStart ? 4.0f * id.bary.y * (1.0f + p.sine)
                             : 4.0f * (1.0f - id.bary.y) * (1.0f - p.sine)) /
                    p.cosine;
    float factor = 1.0f / (1.0f + tangent * tangent);
    up = (1.0f - tangent * tangent) * factor;
    if (isStart) up = -up;
    off = 2.0f * tangent * factor;
  }
  vec3 normalL = normalize(p.axis * up + away * off);
  vec3 centre = p.start + p.axis * (p.axisLength * share);
  float radius = p.startRadius + (p.endRadius - p.startRadius) * share;
  ShapePoint point = shapePointOn(centre + normalL * radius, normalL);
  point.dpdu = cross(p.axis, away);
  point.dpdv = p.axis * off - away * up;
  point.uv = vec2(shapeTurn(around), marks.z + (marks.w - marks.z) * share);
  float widest = max(p.startRadius, p.endRadius);
  point.extent =
      max(abs(p.start), abs(p.start + p.axis * p.axisLength)) + vec3(widest, widest, widest);
  return point;
}

RL_FN SurfaceId curvesDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  return surfaceIdNone();
}

RL_FN float curvesDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  return 0.0f;
}
