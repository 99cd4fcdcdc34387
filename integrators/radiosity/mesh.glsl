// The mesh of elements. A triangle whose edges are divided in n has n^2 elements, in rows along its
// first edge: in row j the ones like the triangle and the ones turned by half a turn take turns.

RL_FN uvec4 meshElementVertices(uint element) {
  return RL_EARLIER_UVEC4(gBuffers.elements, element * RL_RADIOSITY_ELEMENT_UVEC4S);
}

// Place of a hit: the element and the weights of its vertices.
RL_FN ElementPlace meshPlace(RL_IN(SurfaceId) id) {
  uint triangle = 2u * (gBuffers.instances.data[id.instance] + id.primitive);
  uint first = gBuffers.triangles.data[triangle];
  uint n = gBuffers.triangles.data[triangle + 1u];
  float x = clamp(id.bary.x, 0.0f, 1.0f) * float(n);
  float y = clamp(id.bary.y, 0.0f, 1.0f) * float(n);
  uint j = RL_LESSER(uint(y), n - 1u);
  uint i = RL_LESSER(uint(x), n - 1u - j);
  float u = clamp(x - float(i), 0.0f, 1.0f);
  float v = clamp(y - float(j), 0.0f, 1.0f);
  bool isTurned = u + v > 1.0f && i + j + 1u < n;
  ElementPlace place;
  place.element = first + j * (2u * n - j) + 2u * i + (isTurned ? 1u : 0u);
  place.weights = vec3(1.0f - u - v, u, v);
  if (isTurned) place.weights = vec3(u + v - 1.0f, 1.0f - u, 1.0f - v);
  place.weights = max(place.weights, vec3(0.0f, 0.0f, 0.0f));
  float sum = place.weights.x + place.weights.y + place.weights.z;
  place.weights = place.weights * rlSafeDivide(1.0f, sum);
  return place;
}

// A point of an element, by the weights of its second and third vertex.
RL_FN SurfaceId meshPoint(uint element, RL_IN(vec2) weights) {
  uvec4 q = RL_EARLIER_UVEC4(gBuffers.elements, element * RL_RADIOSITY_ELEMENT_UVEC4S + 1u);
  uint i = q.z & 0x7fffu;
  uint j = (q.z >> 15u) & 0x7fffu;
  bool isTurned = (q.z >> 30u) != 0u;
  float step = 1.0f / float(q.w);
  vec2 corner = vec2(float(i), float(j));
  vec2 at = isTurned ? corner + vec2(1.0f, 1.0f) - weights : corner + weights;
  // The turned one has its vertices at (1, 1), (0, 1), (1, 0).
  SurfaceId id;
  id.instance = q.x;
  id.primitive = q.y;
  id.bary = at * step;
  return id;
}

// Fixed points of an element: the middles of its four quarters.
RL_FN vec2 meshFixedPoint(uint number) {
  float sixth = 1.0f / 6.0f;
  if (number == 0u) return vec2(2.0f * sixth, 2.0f * sixth);
  if (number == 1u) return vec2(sixth, sixth);
  return number == 2u ? vec2(4.0f * sixth, sixth) : vec2(sixth, 4.0f * sixth);
}

RL_FN Hit meshHit(RL_IN(SurfaceId) id) {
  Hit hit = traceNoHit();
  hit.instance = id.instance;
  hit.primitive = id.primitive;
  hit.bary = id.bary;
  return hit;
}

// The surface where an unknown is, seen from straight above its side.
RL_FN Surface meshUnknown(uint unknown) {
  uvec4 q = RL_EARLIER_UVEC4(gBuffers.vertices, (unknown / 2u) * RL_RADIOSITY_VERTEX_UVEC4S);
  SurfaceId id;
  id.instance = q.x;
  id.primitive = q.y;
  id.bary = vec2(uintBitsToFloat(q.z), uintBitsToFloat(q.w));
  SurfacePoint p = surfacePointAt(id);
  vec3 down = (unknown & 1u) == 0u ? -p.normalW : p.normalW;
  Surface s = surfaceLoad(meshHit(id), down);
  // One texel of a normal map does not speak for an element.
  if (RL_HAS(RL_FEATURE_NORMAL_MAPS)) {
    Material material = recordMaterial(recordInstance(id.instance).material);
    if (material.textures[RL_TEX_NORMAL] != RL_INVALID) s.nShadeW = s.nGeoW;
  }
  return s;
}

// Area that an unknown stands for, m^2.
RL_FN float meshUnknownArea(uint unknown) {
  uint at = (unknown / 2u) * RL_RADIOSITY_VERTEX_UVEC4S + 1u;
  uvec4 q = RL_EARLIER_UVEC4(gBuffers.vertices, at);
  return uintBitsToFloat(q.x);
}

// Irradiance of a side of an element at a place.
RL_FN vec3 meshIrradiance(uint side, RL_IN(vec3) weights) {
  uvec4 corners = meshElementVertices(side / 2u);
  uint back = side & 1u;
  return weights.x * gBuffers.irradiance.data[2u * corners.x + back] +
         weights.y * gBuffers.irradiance.data[2u * corners.y + back] +
         weights.z * gBuffers.irradiance.data[2u * corners.z + back];
}

// Mean irradiance of a side of an element.
RL_FN vec3 meshMeanIrradiance(uint side) {
  float third = 1.0f / 3.0f;
  return meshIrradiance(side, vec3(third, third, third));
}

// Side of an element, 0 its front, from which a direction arrives.
RL_FN uint meshSideSeen(RL_IN(vec3) frontW, RL_IN(vec3) dirW) {
  return dot(frontW, dirW) < 0.0f ? 0u : 1u;
}

RL_FN bool solveIsDone() { return gBuffers.state.data[RL_RADIOSITY_IS_SOLVED] != 0u; }
