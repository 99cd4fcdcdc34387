// Ray traversal has one signature; each backend supplies the body (Embree on the CPU; the project's
// own hierarchy or ray queries on the GPU).
//   RL_RAY_PATH    hit.instance is RL_INVALID when nothing was hit; alpha is decided by `key`:
//                  the decision does not depend on the order in which surfaces are visited.
//                  The return value is 1 when no partly transparent surface was passed, less when
//                  one may have been (surfaces beyond the hit count too, if traversal met them)
//   RL_RAY_SHADOW  the return value is the transmittance: 0 blocked, 1 free, between through alpha.
//                  `key` is the rank of the body that the ray is in (0: none): bodies below it have
//                  no surface there (core/transport/media.glsl)
//   RL_RAY_BODIES  hit is a body's surface in the interval, of the first instance that has one,
//                  counted cyclically from `key` on. hit.t is not set. Only if
//                  gScene.bodiesMeet
RL_PROTO(float traceRay(RL_IN(Ray) ray, uint mode, uint key, RL_OUT(Hit) hit))

// Initial value of a hit, for compilers that do not see that traversal sets it.
RL_FN Hit traceNoHit() {
  Hit hit;
  hit.instance = RL_INVALID;
  hit.primitive = RL_INVALID;
  hit.bary = vec2(0.0f, 0.0f);
  hit.t = 0.0f;
  return hit;
}

// Returns whether `cand`, a body's surface, replaces `best`. For RL_RAY_BODIES.
RL_FN bool traceIsNextBody(RL_IN(Hit) best, RL_IN(Hit) cand, uint key) {
  if (recordInstance(cand.instance).flags >> RL_INSTANCE_RANK_SHIFT == 0u) return false;
  return best.instance == RL_INVALID || cand.instance - key < best.instance - key;
}

// Hash of a corner's position, the same for every triangle and vertex with that position.
RL_FN uint traceCornerBits(RL_IN(Geometry) geometry, uint corner) {
  vec3 p = RL_SCENE_VEC3(gScene.positions, geometry.firstVertex + corner);
  return rngHash(rngHash(rngHash(floatBitsToUint(p.x)) + floatBitsToUint(p.y)) +
                 floatBitsToUint(p.z));
}

// Part of the instance that an alpha test decides on: the triangle, or the edge or corner that the
// hit lies on. Triangles that share an edge or corner are all hit there, and count as one surface.
// isShared: 1 if the hit is on an edge or corner.
RL_FN uint traceAlphaPart(RL_IN(Hit) hit, RL_OUT(uint) isShared) {
  isShared = 0u;
  // A ray may cross a shape several times: each place decides for itself, to a thousandth of the
  // coordinates, so that rounding rarely changes it.
  if (RL_HAS_SHAPES && shapeIs(recordGeometry(recordInstance(hit.instance).geometry))) {
    // Some kinds have a coordinate there, too (core/geometry/field/point.glsl).
    uint part = hit.primitive < 8u ? hit.primitive : hit.primitive >> 20u;
    return part ^ (uint(hit.bary.x * 1023.0f) << 8u) ^ (uint(hit.bary.y * 1023.0f) << 18u);
  }
  float b0 = 1.0f - hit.bary.x - hit.bary.y;
  bool on0 = !(b0 > RL_EDGE_BARY);
  bool on1 = !(hit.bary.x > RL_EDGE_BARY);
  bool on2 = !(hit.bary.y > RL_EDGE_BARY);
  isShared = on0 || on1 || on2 ? 1u : 0u;
  if (isShared == 0u) return hit.primitive;
  Geometry geometry = recordGeometry(recordInstance(hit.instance).geometry);
  uvec3 corners = RL_SCENE_UVEC3(gScene.triangles, geometry.firstTriangle + hit.primitive);
  uint bits = 0u;
  if (!on0) bits += traceCornerBits(geometry, corners.x);
  if (!on1) bits += traceCornerBits(geometry, corners.y);
  if (!on2) bits += traceCornerBits(geometry, corners.z);
  return bits;
}

RL_FN uint traceAlphaBits(RL_IN(Hit) hit, uint part, uint alphaKey) {
  return rngHash(rngHash(part ^ alphaKey) + hit.instance * 0x9e3779b9u);
}

// Decides whether a path ray hits a partly transparent surface: hash(sample, part of the surface)
// against alpha.
RL_FN bool traceAlphaAccepts(uint alphaKey, RL_IN(Hit) hit, float alpha) {
  uint isShared;
  uint part = traceAlphaPart(hit, isShared);
  return rngUnit(traceAlphaBits(hit, part, alphaKey)) < alpha;
}

RL_FN AlphaPassed traceAlphaNone() {
  AlphaPassed passed;
  passed.transmittance = 1.0f;
  for (uint i = 0u; i < RL_ALPHA_EDGES; i = i + 1u) passed.edges[i] = 0u;
  passed.count = 0u;
  return passed;
}

// Counts a surface that the ray has passed, once for all triangles at the same edge or corner.
RL_FN void traceAlphaPass(RL_INOUT(AlphaPassed) passed, RL_IN(Hit) hit, float alpha) {
  uint isShared;
  uint part = traceAlphaPart(hit, isShared);
  if (isShared != 0u) {
    uint bits = max(traceAlphaBits(hit, part, 0u), 1u);
    for (uint i = 0u; i < RL_ALPHA_EDGES; i = i + 1u) {
      if (passed.edges[i] == bits) return;
    }
    passed.edges[passed.count % RL_ALPHA_EDGES] = bits;
    passed.count = passed.count + 1u;
  }
  passed.transmittance *= 1.0f - alpha;
}
