// traceRay() on the project's own hierarchy: front to back, both levels in one loop. The ray
// parameter stays the same inside an instance: the direction is transformed and not normalised.

// Permutes the components of v so that the one of `axis` comes last.
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
  // Avoid infinities: 0 times infinity would be NaN.
  vec3 d = dir;
  if (abs(d.x) < 1.0e-18f) d.x = 1.0e-18f;
  if (abs(d.y) < 1.0e-18f) d.y = 1.0e-18f;
  if (abs(d.z) < 1.0e-18f) d.z = 1.0e-18f;
  r.inverseDir = vec3(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
  return r;
}

// Ray parameter at which the ray enters child `shift / 8` of a node, at least tMin; 3e38 on a miss.
// near and far: the bytes of the planes that the ray meets first and last. The exit is moved out by
// the rounding error of the slab test (Ize 2013), so that no box hides its content.
RL_FN float bvhEnter(RL_IN(BvhRay) r, RL_IN(vec3) origin, RL_IN(vec3) cell, RL_IN(uvec3) near,
                     RL_IN(uvec3) far, uint shift, float tMin, float tMax) {
  vec3 nearBytes = vec3(float((near.x >> shift) & 255u), float((near.y >> shift) & 255u),
                        float((near.z >> shift) & 255u));
  vec3 farBytes = vec3(float((far.x >> shift) & 255u), float((far.y >> shift) & 255u),
                       float((far.z >> shift) & 255u));
  vec3 a = (origin + nearBytes * cell - r.origin) * r.inverseDir;
  vec3 b = (origin + farBytes * cell - r.origin) * r.inverseDir;
  float enterXY = RL_GREATER(a.x, a.y);
  float enterZ = RL_GREATER(a.z, tMin);
  float enter = RL_GREATER(enterXY, enterZ);
  float leaveXY = RL_LESSER(b.x, b.y);
  float leave = RL_LESSER(leaveXY, b.z) * 1.0000008f;
  return enter <= leave && enter <= tMax ? enter : 3.0e38f;
}

// Sorts two children, the nearer one first.
RL_FN void bvhOrder(RL_INOUT(float) entryA, RL_INOUT(uint) childA, RL_INOUT(float) entryB,
                    RL_INOUT(uint) childB) {
  bool swaps = entryB < entryA;
  float entry = entryA;
  uint child = childA;
  entryA = swaps ? entryB : entry;
  childA = swaps ? childB : child;
  entryB = swaps ? entry : entryB;
  childB = swaps ? child : childB;
}

RL_FN BvhHits bvhChildren(RL_IN(BvhRay) r, RL_IN(BvhWords) record, float tMin, float tMax) {
  vec3 origin = vec3(uintBitsToFloat(record.q0.x), uintBitsToFloat(record.q0.y),
                     uintBitsToFloat(record.q0.z));
  vec3 cell = vec3(uintBitsToFloat((record.q0.w & 255u) << 23u),
                   uintBitsToFloat(((record.q0.w >> 8u) & 255u) << 23u),
                   uintBitsToFloat(((record.q0.w >> 16u) & 255u) << 23u));
  uvec3 low = uvec3(record.q1.x, record.q1.y, record.q1.z);
  uvec3 high = uvec3(record.q1.w, record.q2.x, record.q2.y);
  uvec3 near = uvec3(r.inverseDir.x < 0.0f ? high.x : low.x, r.inverseDir.y < 0.0f ? high.y : low.y,
                     r.inverseDir.z < 0.0f ? high.z : low.z);
  uvec3 far = uvec3(r.inverseDir.x < 0.0f ? low.x : high.x, r.inverseDir.y < 0.0f ? low.y : high.y,
                    r.inverseDir.z < 0.0f ? low.z : high.z);
  float e0 = bvhEnter(r, origin, cell, near, far, 0u, tMin, tMax);
  float e1 = bvhEnter(r, origin, cell, near, far, 8u, tMin, tMax);
  float e2 = bvhEnter(r, origin, cell, near, far, 16u, tMin, tMax);
  float e3 = bvhEnter(r, origin, cell, near, far, 24u, tMin, tMax);
  uint c0 = record.q2.z;
  uint c1 = record.q2.w;
  uint c2 = record.q3.x;
  uint c3 = record.q3.y;
  e0 = c0 != RL_INVALID ? e0 : 3.0e38f;
  e1 = c1 != RL_INVALID ? e1 : 3.0e38f;
  e2 = c2 != RL_INVALID ? e2 : 3.0e38f;
  e3 = c3 != RL_INVALID ? e3 : 3.0e38f;
  bvhOrder(e0, c0, e1, c1);
  bvhOrder(e2, c2, e3, c3);
  bvhOrder(e0, c0, e2, c2);
  bvhOrder(e1, c1, e3, c3);
  bvhOrder(e1, c1, e2, c2);
  BvhHits hits;
  hits.child = uvec4(c0, c1, c2, c3);
  hits.entry = vec4(e0, e1, e2, e3);
  return hits;
}

// Projects a corner, relative to the ray's origin, along the ray.
RL_FN vec2 bvhCorner(RL_IN(BvhRay) r, RL_IN(vec3) corner) {
  vec3 v = bvhAxisLast(corner, r.axis);
  return vec2(v.x - r.shear.x * v.z, v.y - r.shear.y * v.z);
}

// Intersects a triangle, watertight (Woop, Benthin and Wald 2013): rounding is monotonic, so that
// the difference of two products has the right sign or is 0, and an edge (0) belongs to both of its
// triangles.
RL_FN bool bvhTriangle(RL_IN(BvhRay) r, RL_IN(BvhWords) record, float tMin, float tMax,
                       RL_INOUT(Hit) hit) {
  vec3 p0 = vec3(uintBitsToFloat(record.q0.x), uintBitsToFloat(record.q0.y),
                 uintBitsToFloat(record.q0.z)) -
            r.origin;
  vec3 p1 = vec3(uintBitsToFloat(record.q0.w), uintBitsToFloat(record.q1.x),
                 uintBitsToFloat(record.q1.y)) -
            r.origin;
  vec3 p2 = vec3(uintBitsToFloat(record.q1.z), uintBitsToFloat(record.q1.w),
                 uintBitsToFloat(record.q2.x)) -
            r.origin;
  vec2 a = bvhCorner(r, p0);
  vec2 b = bvhCorner(r, p1);
  vec2 c = bvhCorner(r, p2);
  float u = c.x * b.y - c.y * b.x;
  float v = a.x * c.y - a.y * c.x;
  float w = b.x * a.y - b.y * a.x;
  bool isInside = min(u, min(v, w)) >= 0.0f || max(u, max(v, w)) <= 0.0f;
  float sum = u + v + w;
  if (!isInside || sum == 0.0f) return false;
  // Compute the distance from the plane: its error is that of a point near the plane
  // (RL_HIT_ERROR), however far the corners are. The largest of the three cross products of edges
  // is the stable normal.
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

RL_FN float traceRay(RL_IN(Ray) ray, uint mode, uint key, RL_OUT(Hit) hit) {
  RL_COUNT_RAY(mode);
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  AlphaPassed passed = traceAlphaNone();
  float nearest = ray.tMax;
  BvhRay world = bvhRay(ray.origin, ray.dir);
  BvhRay r = world;
  uint instance = RL_INVALID;  // instance whose mesh is traversed
  bool isTransparent = false;  // the instance may be partly transparent
  uint floorOfInstance = 0u;   // stack height at which the instance is left
  uint height = 0u;
  uint current = 0u;
  float fromShape = -3.0e38f;  // a shape is searched beyond this
  BvhStack stack;
  for (;;) {
    bool pops = true;
    bool isMet = false;  // `cand` is a hit, to be accepted or not
    Hit cand = hit;
    bool asks = false;  // whether cand may be transparent
    uint kind = current & RL_BVH_KIND;
    // Load nodes and triangles by one set of instructions: divergent lanes pay for both branches
    // below, but only once for this load.
    uint at = (current & RL_BVH_INSTANCE) == 0u ? current & RL_BVH_LEAF_FIRST : 0u;
    at = at * RL_BVH_RECORD_UVEC4S;
    BvhWords record;
    record.q0 = RL_SCENE_UVEC4(gScene.bvh, at);
    record.q1 = RL_SCENE_UVEC4(gScene.bvh, at + 1u);
    record.q2 = RL_SCENE_UVEC4(gScene.bvh, at + 2u);
    record.q3 = RL_SCENE_UVEC4(gScene.bvh, at + 3u);
    if (kind == 0u) {
      BvhHits hits = bvhChildren(r, record, ray.tMin, nearest);
      if (hits.entry.w < 3.0e38f) {
        stack.child[height] = hits.child.w;
        stack.entry[height] = hits.entry.w;
        height = height + 1u;
      }
      if (hits.entry.z < 3.0e38f) {
        stack.child[height] = hits.child.z;
        stack.entry[height] = hits.entry.z;
        height = height + 1u;
      }
      if (hits.entry.y < 3.0e38f) {
        stack.child[height] = hits.child.y;
        stack.entry[height] = hits.entry.y;
        height = height + 1u;
      }
      if (hits.entry.x < 3.0e38f) {
        current = hits.child.x;
        pops = false;
      }
    } else if (kind == RL_BVH_LEAF) {
      // Test one triangle per iteration: lanes with fewer triangles need not wait.
      uint left = ((current & ~RL_BVH_KIND) >> RL_BVH_LEAF_COUNT_SHIFT) - 1u;
      if (left > 0u) {
        current = current + 1u - (1u << RL_BVH_LEAF_COUNT_SHIFT);
        pops = false;
      }
      isMet = bvhTriangle(r, record, ray.tMin, nearest, cand);
      cand.instance = instance == RL_INVALID ? record.q2.z : instance;
      cand.primitive = record.q2.w;
      asks = instance == RL_INVALID ? record.q2.y != 0u : isTransparent;
    } else if (RL_HAS_SHAPES && kind == RL_BVH_KIND && current != RL_INVALID) {
      cand.instance = current & ~RL_BVH_KIND;
      Instance inst = recordInstance(cand.instance);
      Ray part = ray;
      part.tMin = max(ray.tMin, fromShape);
      part.tMax = nearest;
      isMet = shapeTrace(inst, recordGeometry(inst.geometry), part, cand);
      asks = (inst.flags & RL_INSTANCE_ALPHA) != 0u;
      fromShape = -3.0e38f;
    } else if (RL_HAS(RL_FEATURE_INSTANCES) && kind == RL_BVH_INSTANCE) {
      instance = current & ~RL_BVH_KIND;
      Instance inst = recordInstance(instance);
      isTransparent = (inst.flags & RL_INSTANCE_ALPHA) != 0u;
      floorOfInstance = height;
      vec4 o = vec4(world.origin, 1.0f);
      vec4 d = vec4(world.dir, 0.0f);
      r = bvhRay(vec3(dot(inst.worldToObjectRow0, o), dot(inst.worldToObjectRow1, o),
                      dot(inst.worldToObjectRow2, o)),
                 vec3(dot(inst.worldToObjectRow0, d), dot(inst.worldToObjectRow1, d),
                      dot(inst.worldToObjectRow2, d)));
      current = RL_SCENE_UINT(gScene.bvhRoots, inst.geometry);
      pops = false;
    }
    if (isMet) {
      float alpha = 1.0f;
      if (RL_HAS(RL_FEATURE_ALPHA) && asks) alpha = surfaceAlpha(cand);
      bool accepts = true;
      if (RL_HAS(RL_FEATURE_VOLUME) && gScene.bodiesMeet != 0u && mode != RL_RAY_PATH) {
        if (mode == RL_RAY_BODIES) {
          if (traceIsNextBody(hit, cand, key)) hit = cand;
          accepts = false;
        } else if (mediaPasses(key, cand)) {
          accepts = false;
        }
        if (!accepts) alpha = 1.0f;
      }
      if (RL_HAS(RL_FEATURE_ALPHA) && alpha < 1.0f) {
        accepts = mode == RL_RAY_PATH && traceAlphaAccepts(key, cand, alpha);
        if (!accepts) traceAlphaPass(passed, cand, alpha);
      }
      if (accepts) {
        hit = cand;
        nearest = cand.t;
        if (mode == RL_RAY_SHADOW) return 0.0f;
      } else if (RL_HAS_SHAPES && kind == RL_BVH_KIND) {
        // The ray goes on through the same shape.
        fromShape = cand.t;
        pops = false;
      }
    }
    if (pops) {
      if (RL_HAS(RL_FEATURE_INSTANCES) && instance != RL_INVALID && height == floorOfInstance) {
        instance = RL_INVALID;
        r = world;
      }
      if (height == 0u) return passed.transmittance;
      height = height - 1u;
      // Skip entries behind the nearest hit: the next iteration pops the next one.
      current = stack.entry[height] <= nearest ? stack.child[height] : RL_INVALID;
    }
  }
}
