// traceRay() on the project's own hierarchy: front to back, both levels in one loop. The ray keeps
// its parameter in an instance, where its direction is transformed and not normalised.

// The components of v, that of `axis` last.
RL_FN vec3 bvhAxisLast(RL_IN(vec3) v, uint axis) {
  if (axis == 0u) return vec3(v.y, v.z, v.x);
  if (axis == 1u) return vec3(v.z, v.x, v.y);
  return v;
}

RL_FN BvhRay bvhRay(RL_IN(vec3) origin, RL_IN(vec3) dir) {
  BvhRay r;
  r.origin = origin;
  r.dir = dir;
  vec3 size = abs(dir);
  r.axis = size.x > size.y ? 0u : 1u;
  if (size.z > max(size.x, size.y)) r.axis = 2u;
  vec3 along = bvhAxisLast(dir, r.axis);
  r.shear = vec2(along.x / along.z, along.y / along.z);
  // No infinities: 0 times one of them would be no number.
  vec3 d = dir;
  if (abs(d.x) < 1.0e-18f) d.x = 1.0e-18f;
  if (abs(d.y) < 1.0e-18f) d.y = 1.0e-18f;
  if (abs(d.z) < 1.0e-18f) d.z = 1.0e-18f;
  r.inverseDir = vec3(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
  return r;
}

// Where the ray enters a box, at least tMin; 3e38 where it misses. The exit is moved out by the
// rounding error of the slab test (Ize 2013), so that no box hides what it holds.
RL_FN float bvhEnter(RL_IN(BvhRay) r, RL_IN(vec3) low, RL_IN(vec3) high, float tMin, float tMax) {
  vec3 a = (low - r.origin) * r.inverseDir;
  vec3 b = (high - r.origin) * r.inverseDir;
  vec3 near = min(a, b);
  vec3 far = max(a, b);
  float enter = max(max(near.x, near.y), max(near.z, tMin));
  float leave = min(min(far.x, far.y), far.z) * 1.0000008f;
  return enter <= min(leave, tMax) ? enter : 3.0e38f;
}

// A corner, relative to the origin, as the ray sees it.
RL_FN vec2 bvhCorner(RL_IN(BvhRay) r, RL_IN(vec3) corner) {
  vec3 v = bvhAxisLast(corner, r.axis);
  return vec2(v.x - r.shear.x * v.z, v.y - r.shear.y * v.z);
}

// Watertight (Woop, Benthin and Wald 2013): rounding is monotonic, so that the difference of two
// products has the right sign or is 0, and an edge (0) belongs to both of its triangles.
RL_FN bool bvhTriangle(RL_IN(BvhRay) r, RL_IN(BvhTriangle) triangle, float tMin, float tMax,
                       RL_INOUT(Hit) hit) {
  vec3 p0 = triangle.p0 - r.origin;
  vec3 p1 = triangle.p1 - r.origin;
  vec3 p2 = triangle.p2 - r.origin;
  vec2 a = bvhCorner(r, p0);
  vec2 b = bvhCorner(r, p1);
  vec2 c = bvhCorner(r, p2);
  float u = c.x * b.y - c.y * b.x;
  float v = a.x * c.y - a.y * c.x;
  float w = b.x * a.y - b.y * a.x;
  bool isInside = min(u, min(v, w)) >= 0.0f || max(u, max(v, w)) <= 0.0f;
  float sum = u + v + w;
  if (!isInside || sum == 0.0f) return false;
  // The distance by the plane: its error is that of a point near the plane (RL_HIT_ERROR), however
  // far the corners are. The largest of the three products of edges is the stable normal.
  vec3 e0 = p2 - p0;
  vec3 e1 = p0 - p1;
  vec3 e2 = p1 - p2;
  vec3 n = cross(e0, e1);
  vec3 n12 = cross(e1, e2);
  vec3 n20 = cross(e2, e0);
  if (dot(n12, n12) > dot(n, n)) n = n12;
  if (dot(n20, n20) > dot(n, n)) n = n20;
  float den = dot(n, r.dir);
  if (den == 0.0f) return false;
  float t = dot(p0, n) / den;
  if (!(t >= tMin && t <= tMax)) return false;
  hit.t = t;
  hit.bary = vec2(v / sum, w / sum);
  return true;
}

RL_FN float traceRay(RL_IN(Ray) ray, uint mode, uint alphaKey, RL_OUT(Hit) hit) {
  RL_COUNT_RAY(mode);
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  float transmittance = 1.0f;
  float nearest = ray.tMax;
  BvhRay world = bvhRay(ray.origin, ray.dir);
  BvhRay r = world;
  uint instance = RL_INVALID;  // the one whose mesh is traversed
  bool isTransparent = false;  // that instance, in part
  uint floorOfInstance = 0u;   // height of the stack at which it is left
  uint height = 0u;
  uint current = 0u;
  BvhStack stack;
  for (;;) {
    bool pops = true;
    uint kind = current & RL_BVH_KIND;
    if (kind == 0u) {
      BvhNode node = gScene.bvhNodes.data[current];
      float enter0 = bvhEnter(r, node.low0, node.high0, ray.tMin, nearest);
      float enter1 = bvhEnter(r, node.low1, node.high1, ray.tMin, nearest);
      bool is0First = enter0 <= enter1;
      float enterNear = min(enter0, enter1);
      float enterFar = max(enter0, enter1);
      if (enterNear < 3.0e38f) {
        current = is0First ? node.child0 : node.child1;
        pops = false;
        if (enterFar < 3.0e38f) {
          stack.child[height] = is0First ? node.child1 : node.child0;
          stack.entry[height] = enterFar;
          height = height + 1u;
        }
      }
    } else if (kind == RL_BVH_LEAF) {
      uint first = current & RL_BVH_LEAF_FIRST;
      uint count = (current & ~RL_BVH_KIND) >> RL_BVH_LEAF_COUNT_SHIFT;
      for (uint i = 0u; i < count; i = i + 1u) {
        BvhTriangle triangle = gScene.bvhTriangles.data[first + i];
        Hit cand = hit;
        if (!bvhTriangle(r, triangle, ray.tMin, nearest, cand)) continue;
        cand.instance = instance == RL_INVALID ? triangle.instance : instance;
        cand.primitive = triangle.primitive;
        float alpha = 1.0f;
        if (RL_HAS(RL_FEATURE_ALPHA)) {
          bool asks = instance == RL_INVALID ? triangle.isTransparent != 0u : isTransparent;
          if (asks) alpha = surfaceAlpha(cand);
        }
        if (mode == RL_RAY_SHADOW) {
          transmittance *= 1.0f - alpha;
          if (transmittance == 0.0f) return 0.0f;
        } else {
          bool accepts = true;
          if (RL_HAS(RL_FEATURE_ALPHA) && alpha < 1.0f) {
            accepts = traceAlphaAccepts(alphaKey, cand, alpha);
          }
          if (accepts) {
            hit = cand;
            nearest = cand.t;
          } else {
            transmittance *= 1.0f - alpha;
          }
        }
      }
    } else {
      instance = current & ~RL_BVH_KIND;
      Instance inst = gScene.instances.data[instance];
      isTransparent = (inst.flags & RL_INSTANCE_ALPHA) != 0u;
      floorOfInstance = height;
      vec4 o = vec4(world.origin, 1.0f);
      vec4 d = vec4(world.dir, 0.0f);
      r = bvhRay(vec3(dot(inst.worldToObjectRow0, o), dot(inst.worldToObjectRow1, o),
                      dot(inst.worldToObjectRow2, o)),
                 vec3(dot(inst.worldToObjectRow0, d), dot(inst.worldToObjectRow1, d),
                      dot(inst.worldToObjectRow2, d)));
      current = gScene.bvhRoots.data[inst.geometry];
      pops = false;
    }
    while (pops) {
      if (instance != RL_INVALID && height == floorOfInstance) {
        instance = RL_INVALID;
        r = world;
      }
      if (height == 0u) return transmittance;
      height = height - 1u;
      current = stack.child[height];
      pops = !(stack.entry[height] <= nearest);
    }
  }
}
