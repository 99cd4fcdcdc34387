// A surface of rational Bezier pieces over a grid of (u, v) (core/scene/splines/surface_words.h
// says what its words are). An id holds (u, v), each column and row of the grid of equal width.
// Textures: (u, v) of the knots, from 0 to 1.

RL_FN uvec4 nurbsHead(RL_IN(Shape) shape) {
  return RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord);  // columns, rows, degrees
}

// First word of a piece: origin and radius, normal and sine of its cone, (u0, v0, u1, v1), net.
RL_FN uint nurbsPiece(RL_IN(Shape) shape, RL_IN(uvec4) head, uint piece) {
  uint first = RL_SCENE_UVEC4(gScene.shapeWords, shape.firstWord + 1u).w;
  return shape.firstWord + first + piece * (3u + (head.z + 1u) * (head.w + 1u));
}

// Evaluates a piece: its point relative to its origin, and the derivatives along s and t. All
// points of a net are sums of few rounded terms of the piece's size, whatever its place.
RL_FN void nurbsEvaluate(RL_IN(uvec4) head, uint piece, RL_IN(vec2) st, RL_OUT(vec3) at,
                         RL_OUT(vec3) ds, RL_OUT(vec3) dt) {
  uint net = piece + 3u;
  uint n = head.z;
  uint m = head.w;
  float restS = 1.0f - st.x;
  float restT = 1.0f - st.y;
  vec4 zero = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  vec4 low = zero;   // Bernstein sum of degree m - 1 over all rows but the last
  vec4 high = zero;  // the same over all but the first
  vec4 lowDs = zero;
  vec4 highDs = zero;
  float factorT = 1.0f;  // binomial times a power of t
  for (uint j = 0u; j <= m; j = j + 1u) {
    // Sums of a row likewise, by Horner's rule in s over 1 - s.
    uint row = net + j * (n + 1u);
    vec4 next = shapeVec4(row + 1u);
    vec4 a = shapeVec4(row);
    vec4 b = next;
    float factorS = 1.0f;
    for (uint i = 1u; i < n; i = i + 1u) {
      factorS = factorS * st.x * float(n - i) / float(i);
      a = a * restS + next * factorS;
      next = shapeVec4(row + i + 1u);
      b = b * restS + next * factorS;
    }
    vec4 value = a * restS + b * st.x;
    vec4 slope = (b - a) * float(n);
    if (j > 0u) {
      // The factor is still that of the row before.
      high = high * restT + value * factorT;
      highDs = highDs * restT + slope * factorT;
    }
    if (j < m) {
      if (j > 0u) factorT = factorT * st.y * float(m - j) / float(j);
      low = low * restT + value * factorT;
      lowDs = lowDs * restT + slope * factorT;
    }
  }
  vec4 h = low * restT + high * st.y;
  vec4 hs = lowDs * restT + highDs * st.y;
  vec4 ht = (high - low) * float(m);
  float inverse = 1.0f / h.w;
  at = vec3(h.x, h.y, h.z) * inverse;
  ds = (vec3(hs.x, hs.y, hs.z) - at * hs.w) * inverse;
  dt = (vec3(ht.x, ht.y, ht.z) - at * ht.w) * inverse;
}

// The place that a step from st leads to. Around a pole s and t are polar, and a step is that of
// the flat coordinates (t, s t), in which the surface is regular: the turn shrinks as the distance
// from the pole grows. The surface goes on beyond the edges of a piece, so that a step may leave
// it.
//   pole: 1 to 4: the edge s = 0, s = 1, t = 0, t = 1 is one point; 0: none is
RL_FN vec2 nurbsStep(RL_IN(vec2) st, RL_IN(vec2) forth, uint pole) {
  vec2 turned = forth;
  if (pole != 0u) {
    float far = pole > 2u ? st.y : st.x;
    float away = pole > 2u ? forth.y : forth.x;
    if ((pole & 1u) == 0u) {
      far = 1.0f - far;
      away = -away;
    }
    float turns = rlSafeDivide(far, far + away);
    turned = pole > 2u ? vec2(forth.x * turns, forth.y) : vec2(forth.x, forth.y * turns);
  }
  float beyond = pole != 0u ? 1.0f : 0.3f;
  return clamp(st + turned, vec2(-beyond, -beyond), vec2(1.0f + beyond, 1.0f + beyond));
}

// The step of s and t that moves a point of the surface along v, as closely as its plane allows.
RL_FN vec2 nurbsAlong(RL_IN(vec3) ds, RL_IN(vec3) dt, RL_IN(vec3) v) {
  float ss = dot(ds, ds);
  float st = dot(ds, dt);
  float tt = dot(dt, dt);
  vec2 d = vec2(dot(v, ds), dot(v, dt));
  return vec2(tt * d.x - st * d.y, ss * d.y - st * d.x) * rlSafeDivide(1.0f, ss * tt - st * st);
}

// The place on a piece near st that is in a plane through the line: across is unit, normal to both.
RL_FN vec2 nurbsIntoPlane(RL_IN(uvec4) head, uint piece, RL_IN(vec3) closest, RL_IN(vec3) across,
                          uint pole, RL_IN(vec2) st) {
  vec3 at;
  vec3 ds;
  vec3 dt;
  nurbsEvaluate(head, piece, st, at, ds, dt);
  return nurbsStep(st, nurbsAlong(ds, dt, across) * dot(closest - at, across), pole);
}

// Finds where a line meets a piece, by Newton's method on the two distances from the line, from st.
// On its way it may leave the piece a little, since the surface goes on there: no edge bends it.
// A line that passes an edge closer than float32 can tell meets it: none slips through between two
// pieces.
//   closest: the line's point closest to the origin of the piece, relative to that
// Returns whether it meets, and sets st and `along`, the distance from `closest`.
RL_FN bool nurbsNewton(RL_IN(uvec4) head, uint piece, RL_IN(vec3) closest, RL_IN(vec3) dir,
                       float tolerance, uint pole, RL_INOUT(vec2) st, RL_OUT(float) along) {
  vec2 none = vec2(0.0f, 0.0f);
  vec2 whole = vec2(1.0f, 1.0f);
  vec3 x;
  vec3 y;
  frameFromNormal(dir, x, y);
  along = 0.0f;
  uint edge = 0u;  // 1: the search left the piece, which leaves t, 2: s, 3: nothing; on an edge
  uint last = 20u;
  for (uint i = 0u; i <= last; i = i + 1u) {
    vec3 at;
    vec3 ds;
    vec3 dt;
    nurbsEvaluate(head, piece, st, at, ds, dt);
    at = at - closest;
    along = dot(at, dir);
    vec2 miss = vec2(dot(at, x), dot(at, y));
    vec2 onPiece = clamp(st, none, whole);
    if (dot(miss, miss) <= tolerance * tolerance && onPiece == st) return true;
    vec2 missDs = vec2(dot(ds, x), dot(ds, y));
    vec2 missDt = vec2(dot(dt, x), dot(dt, y));
    if (edge != 0u) {
      // The point of the edge that is closest to the line.
      if (edge == 1u) st.y = st.y - rlSafeDivide(dot(miss, missDt), dot(missDt, missDt));
      if (edge == 2u) st.x = st.x - rlSafeDivide(dot(miss, missDs), dot(missDs, missDs));
      st = clamp(st, none, whole);
      continue;
    }
    float det = missDs.x * missDt.y - missDs.y * missDt.x;
    if (det == 0.0f) return false;
    vec2 forth =
        vec2(miss.y * missDt.x - miss.x * missDt.y, miss.x * missDs.y - miss.y * missDs.x) *
        (1.0f / det);
    vec2 next = nurbsStep(st, forth, pole);
    vec2 moved = abs(next - st);
    st = next;
    if (max(moved.x, moved.y) < 1.0e-3f) {
      // A search that is about to end beside the piece goes on upon its edge.
      onPiece = clamp(st, none, whole);
      vec2 beside = abs(st - onPiece);
      if (max(beside.x, beside.y) > 0.01f) return false;
      if (max(moved.x, moved.y) < 1.0e-6f || i == 16u) {
        st = onPiece;
        edge = (beside.x > 0.0f ? 1u : 0u) + (beside.y > 0.0f ? 2u : 0u);
        last = edge == 0u ? i + 1u : i + 3u;
        if (edge == 0u) edge = 3u;
      }
    }
  }
  return false;
}

// Share of a step after which one coordinate has changed by `room`.
//   far, away: distance from a pole, and its change by the step; 1 and 0 without one
RL_FN float nurbsShare(float room, float forth, float far, float away) {
  float share = rlSafeDivide(room * far, forth * far - room * away);
  return share > 0.0f ? share : 3.0e38f;
}

// Share of a step after which it is a little beyond the piece; atPole: as far beyond a pole.
RL_FN float nurbsWay(RL_IN(vec2) st, RL_IN(vec2) forth, uint pole, float atPole) {
  vec2 low = vec2(pole == 1u ? -atPole : -0.1f, pole == 3u ? -atPole : -0.1f);
  vec2 high = vec2(pole == 2u ? 1.0f + atPole : 1.1f, pole == 4u ? 1.0f + atPole : 1.1f);
  vec2 room = vec2(forth.x < 0.0f ? low.x : high.x, forth.y < 0.0f ? low.y : high.y) - st;
  vec2 far = (pole & 1u) == 0u ? vec2(1.0f, 1.0f) - st : st;
  vec2 away = (pole & 1u) == 0u ? -forth : forth;
  float shareX = pole > 2u ? nurbsShare(room.x, forth.x, far.y, away.y)
                           : nurbsShare(room.x, forth.x, 1.0f, 0.0f);
  float shareY = pole == 1u || pole == 2u ? nurbsShare(room.y, forth.y, far.x, away.x)
                                          : nurbsShare(room.y, forth.y, 1.0f, 0.0f);
  float share = min(shareX, shareY);
  return share < 3.0e38f ? share : 0.0f;
}

// Intersects one piece. A ray that is steep against the normals of the piece meets it once at most,
// and Newton's method begins in the middle. Any other may meet it twice, on either side of where
// the surface turns away. The points lie in a plane through the ray, near the normal: a search
// begins at either end of the piece in this plane, and finds the point on its side. Where the
// surface is not like a quadric, ends that are found in other ways help: before and beyond a pole,
// or at once.
RL_FN bool nurbsPieceIntersect(RL_IN(uvec4) head, uint first, uint piece, uint pole, RL_IN(Ray) ray,
                               RL_INOUT(Hit) hit) {
  float size = sqrt(dot(ray.dir, ray.dir));
  vec3 dir = ray.dir * (1.0f / size);
  vec4 place = shapeVec4(first);
  vec4 cone = shapeVec4(first + 1u);
  vec3 origin = ray.origin - vec3(place);
  float middle = -dot(origin, dir);
  vec3 closest = origin + dir * middle;
  float tolerance = 5.0e-7f * (place.w + sqrt(dot(origin, origin)));
  vec2 from = vec2(0.5f, 0.5f);
  bool isSteep = abs(dot(dir, vec3(cone))) > cone.w;
  vec3 across = cross(dir, vec3(cone));
  if (!isSteep) {
    across = across * rlSafeDivide(1.0f, sqrt(dot(across, across)));
    from = nurbsIntoPlane(head, first, closest, across, pole, from);
    from = nurbsIntoPlane(head, first, closest, across, pole, from);
  }
  bool found = false;
  for (uint i = 0u; i < (isSteep ? 1u : 6u); i = i + 1u) {
    if (pole == 0u && i / 2u == 1u) continue;
    vec2 st = from;
    // A way that is straight in s and t leaves the plane, by what its second part makes good.
    for (uint k = 0u; k < (isSteep ? 0u : i < 4u ? 2u : 1u); k = k + 1u) {
      vec3 at;
      vec3 ds;
      vec3 dt;
      nurbsEvaluate(head, first, st, at, ds, dt);
      vec2 way = nurbsAlong(ds, dt, (i & 1u) == 0u ? -dir : dir);
      st = nurbsStep(st, way * nurbsWay(st, way, pole, i < 2u ? -0.01f : 0.1f), pole);
      st = nurbsIntoPlane(head, first, closest, across, pole, st);
    }
    float along;
    if (!nurbsNewton(head, first, closest, dir, tolerance, pole, st, along)) continue;
    float t = (middle + along) / size;
    if (!(t > ray.tMin) || !(t < (found ? hit.t : ray.tMax))) continue;
    // Searches that end at one point differ by rounding: a ray that goes on does not meet it again.
    if (ray.tMin > 0.0f && (t - ray.tMin) * size < 256.0f * tolerance) {
      vec3 at;
      vec3 ds;
      vec3 dt;
      nurbsEvaluate(head, first, st, at, ds, dt);
      vec3 n = cross(ds, dt);
      float cosine = abs(dot(n, dir)) * rlSafeDivide(1.0f, sqrt(dot(n, n)));
      if ((t - ray.tMin) * size * max(cosine, 0.015625f) < 4.0f * tolerance) continue;
    }
    hit.t = t;
    hit.primitive = 0u;
    vec2 cell = vec2(float(piece % head.x), float(piece / head.x));
    hit.bary = min((cell + st) / vec2(float(head.x), float(head.y)), vec2(1.0f, 1.0f));
    found = true;
  }
  return found;
}

// Walks the hierarchy of boxes, the nearer child first. Children of node k are 2 k and 2 k + 1; the
// bits of `waiting` say on which levels the sibling waits.
RL_FN bool nurbsIntersect(RL_IN(Shape) shape, RL_IN(Ray) ray, RL_INOUT(Hit) hit) {
  uvec4 head = nurbsHead(shape);
  uint nodes = shape.firstWord;  // node k begins at nodes + 2 k; those of k = 0 are the head
  vec3 inverse = shapeInverse(ray.dir);
  Ray left = ray;
  bool found = false;
  uint node = 1u;
  uint waiting = 0u;
  bool goesOn = true;
  while (goesOn) {
    bool isDone = true;  // with this node and all below
    if (shapeEnterBox(nodes + 2u * node, ray.origin, inverse, ray.tMin, left.tMax) < 3.0e38f) {
      uint piece = RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node).w;
      if (piece == RL_INVALID) {
        uint child = 2u * node;
        float low = shapeEnterBox(nodes + 2u * child, ray.origin, inverse, ray.tMin, left.tMax);
        float high =
            shapeEnterBox(nodes + 2u * child + 2u, ray.origin, inverse, ray.tMin, left.tMax);
        if (min(low, high) < 3.0e38f) {
          node = high < low ? child + 1u : child;
          waiting = waiting * 2u + (max(low, high) < 3.0e38f ? 1u : 0u);
          isDone = false;
        }
      } else if (nurbsPieceIntersect(head, nurbsPiece(shape, head, piece), piece,
                                     RL_SCENE_UVEC4(gScene.shapeWords, nodes + 2u * node + 1u).w,
                                     left, hit)) {
        left.tMax = hit.t;
        found = true;
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
      }
    }
  }
  return found;
}

RL_FN ShapePoint nurbsPoint(RL_IN(Shape) shape, RL_IN(SurfaceId) id) {
  uvec4 head = nurbsHead(shape);
  vec2 at = id.bary * vec2(float(head.x), float(head.y));
  uvec2 cell = uvec2(min(uint(at.x), head.x - 1u), min(uint(at.y), head.y - 1u));
  vec2 st = clamp(at - vec2(float(cell.x), float(cell.y)), vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
  uint first = nurbsPiece(shape, head, cell.y * head.x + cell.x);
  vec4 place = shapeVec4(first);
  vec4 grid = shapeVec4(first + 2u);
  vec3 local;
  vec3 ds;
  vec3 dt;
  nurbsEvaluate(head, first, st, local, ds, dt);
  vec3 n = cross(ds, dt);
  // An edge that is one point has the tangents of a place beside it.
  if (!(dot(n, n) > 1.0e-12f * dot(ds, ds) * dot(dt, dt)) ||
      !(min(dot(ds, ds), dot(dt, dt)) > 1.0e-10f * place.w * place.w)) {
    vec3 beside;
    vec2 toMiddle = vec2(0.5f, 0.5f) - st;
    nurbsEvaluate(head, first, st + toMiddle * 1.5258789e-5f, beside, ds, dt);
    n = cross(ds, dt);
  }
  float length2 = dot(n, n);
  vec4 cone = shapeVec4(first + 1u);
  ShapePoint p =
      shapePointOn(vec3(place) + local, length2 > 0.0f ? n * (1.0f / sqrt(length2)) : vec3(cone));
  // Derivatives along the id's coordinates: nurbsDensity() needs their length.
  p.dpdu = ds * float(head.x);
  p.dpdv = dt * float(head.y);
  p.uv = vec2(grid) + st * vec2(grid.z - grid.x, grid.w - grid.y);
  p.extent = vec3(shapeVec4(shape.firstWord + 1u));
  return p;
}

// Uniform in the id's coordinates.
RL_FN SurfaceId nurbsDraw(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(vec2) u) {
  SurfaceId id = surfaceIdNone();
  id.primitive = 0u;
  id.bary = u;
  return id;
}

RL_FN float nurbsDensity(RL_IN(Shape) shape, RL_IN(vec3) receiverL, RL_IN(ShapePoint) point) {
  vec3 n = cross(point.dpdu, point.dpdv);
  return rlSafeDivide(1.0f, sqrt(dot(n, n)));
}
