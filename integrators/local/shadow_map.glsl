// Shadow maps: where a point lies in the map of a lamp, and how much of its light arrives there
// (Williams 1978; percentage-closer filtering: Reeves, Salesin and Cook 1987).
//
// A map holds the distance to the first surface along the ray through each texel's middle. A point
// is lit if it is no farther than that and a bias. The bias covers how far a plane runs away within
// the texels that are compared: their width times the tangent of the angle of incidence.

RL_FN uint localMapSquares(uint shape) { return shape == RL_LOCAL_MAP_CUBE ? 6u : 1u; }

RL_FN LocalLamp localLampRead(uint index) {
  uint at = 1u + index * RL_LOCAL_LAMP_UVEC4S;
  uvec4 q0 = RL_EARLIER_UVEC4(gBuffers.lamps, at);
  uvec4 q1 = RL_EARLIER_UVEC4(gBuffers.lamps, at + 1u);
  uvec4 q2 = RL_EARLIER_UVEC4(gBuffers.lamps, at + 2u);
  LocalLamp lamp;
  lamp.origin = recordVec3(q0);
  lamp.key = q0.w;
  lamp.dir = recordVec3(q1);
  lamp.shape = q1.w;
  lamp.halfWidth = uintBitsToFloat(q2.x);
  lamp.halfHeight = uintBitsToFloat(q2.y);
  lamp.firstSquare = q2.z;
  lamp.isArea = q2.w;
  return lamp;
}

RL_FN void localLampWrite(uint index, RL_IN(LocalLamp) lamp) {
  uint at = 1u + index * RL_LOCAL_LAMP_UVEC4S;
  RL_WRITE_UVEC4(gBuffers.lamps, at, recordUvec4(lamp.origin, lamp.key));
  RL_WRITE_UVEC4(gBuffers.lamps, at + 1u, recordUvec4(lamp.dir, lamp.shape));
  RL_WRITE_UVEC4(gBuffers.lamps, at + 2u,
                 uvec4(floatBitsToUint(lamp.halfWidth), floatBitsToUint(lamp.halfHeight),
                       lamp.firstSquare, lamp.isArea));
}

RL_FN uint localLampCount() { return RL_EARLIER_UVEC4(gBuffers.lamps, 0u).x; }

// The ray of a map through a place of one of its squares.
RL_FN Ray localMapRay(RL_IN(LocalLamp) lamp, uint square, RL_IN(vec2) uv) {
  Ray ray;
  ray.origin = lamp.origin;
  ray.dir = lamp.dir;
  ray.tMin = 0.0f;
  ray.tMax = 3.0e38f;
  if (lamp.shape == RL_LOCAL_MAP_CUBE) {
    float side = (square & 1u) == 0u ? 1.0f : -1.0f;
    uint axis = square >> 1u;
    if (axis == 0u) ray.dir = vec3(side, uv.x, uv.y);
    if (axis == 1u) ray.dir = vec3(uv.x, side, uv.y);
    if (axis == 2u) ray.dir = vec3(uv.x, uv.y, side);
    ray.dir = normalize(ray.dir);
    return ray;
  }
  vec3 across;
  vec3 up;
  frameFromNormal(lamp.dir, across, up);
  vec3 offset = across * (uv.x * lamp.halfWidth) + up * (uv.y * lamp.halfHeight);
  if (lamp.shape == RL_LOCAL_MAP_PARALLEL) {
    ray.origin += offset;
  } else {
    ray.dir = normalize(ray.dir + offset);
  }
  return ray;
}

// Finds a point in the maps of a lamp.
RL_FN LocalMapPlace localMapPlace(RL_IN(LocalLamp) lamp, RL_IN(vec3) posW) {
  LocalMapPlace place;
  place.square = 0u;
  vec3 d = posW - lamp.origin;
  float texels = 1.0f / float(gParams.mapSize);
  if (lamp.shape == RL_LOCAL_MAP_CUBE) {
    vec3 size = abs(d);
    uint axis = size.y > size.x ? 1u : 0u;
    if (size.z > max(size.x, size.y)) axis = 2u;
    float along = axis == 0u ? d.x : (axis == 1u ? d.y : d.z);
    place.square = axis * 2u + (along < 0.0f ? 1u : 0u);
    vec2 rest = vec2(axis == 0u ? d.y : d.x, axis == 2u ? d.y : d.z);
    place.uv = rest * rlSafeDivide(1.0f, abs(along));
    place.distance = length(d);
    place.texelSize = 2.0f * abs(along) * texels;
    place.dirW = d * -rlSafeDivide(1.0f, place.distance);
    return place;
  }
  vec3 across;
  vec3 up;
  frameFromNormal(lamp.dir, across, up);
  float along = dot(d, lamp.dir);
  place.uv =
      vec2(rlSafeDivide(dot(d, across), lamp.halfWidth), rlSafeDivide(dot(d, up), lamp.halfHeight));
  float extent = max(lamp.halfWidth, lamp.halfHeight);
  if (lamp.shape == RL_LOCAL_MAP_PARALLEL) {
    place.distance = along;
    place.dirW = -lamp.dir;
  } else {
    place.uv *= rlSafeDivide(1.0f, along);
    extent *= along;
    place.distance = length(d);
    place.dirW = d * -rlSafeDivide(1.0f, place.distance);
    if (!(along > 0.0f)) place.square = RL_INVALID;
  }
  place.texelSize = 2.0f * extent * texels;
  if (!(max(abs(place.uv.x), abs(place.uv.y)) <= 1.0f)) place.square = RL_INVALID;
  return place;
}

// Column or row of a place in a square.
RL_FN int localMapTexel(float u) {
  int size = int(gParams.mapSize);
  return clamp(int(floor((u * 0.5f + 0.5f) * float(size))), 0, size - 1);
}

// Number of the lamp's maps for a light sample; RL_INVALID: it has none.
RL_FN uint localLampOf(RL_IN(LightSample) light) {
  bool isArea = light.kind == RL_LIGHT_AREA;
  uint key = isArea ? light.id.instance : light.record;
  uint count = localLampCount();
  for (uint i = 0u; i < count; i = i + 1u) {
    uint at = 1u + i * RL_LOCAL_LAMP_UVEC4S;
    bool isSame = RL_EARLIER_UVEC4(gBuffers.lamps, at).w == key;
    if (isSame && (RL_EARLIER_UVEC4(gBuffers.lamps, at + 2u).w != 0u) == isArea) return i;
  }
  return RL_INVALID;
}

// Share of a lamp's light that reaches a surface by its map; -1 outside of the map. Texels beyond a
// square's edge count as those at the edge.
RL_FN float localMapPassed(RL_IN(LocalLamp) lamp, RL_IN(vec3) posW, RL_IN(vec3) nGeoW) {
  LocalMapPlace place = localMapPlace(lamp, posW);
  if (place.square == RL_INVALID) return -1.0f;
  float cosine = min(abs(dot(nGeoW, place.dirW)), 1.0f);
  float tangent = rlSafeDivide(sqrt(1.0f - cosine * cosine), cosine);
  if (!(cosine > 0.0f)) tangent = RL_LOCAL_STEEPEST;
  int radius = int(gParams.mapFilter);
  float width = place.texelSize * float(2 * radius + 1);
  float bias = gParams.mapBias * width * (min(tangent, RL_LOCAL_STEEPEST) + 0.25f);
  int size = int(gParams.mapSize);
  int x = localMapTexel(place.uv.x);
  int y = localMapTexel(place.uv.y);
  uint first = (lamp.firstSquare + place.square) * gParams.mapSize * gParams.mapSize;
  float lit = 0.0f;
  for (int dy = -radius; dy <= radius; dy = dy + 1) {
    for (int dx = -radius; dx <= radius; dx = dx + 1) {
      int column = clamp(x + dx, 0, size - 1);
      int row = clamp(y + dy, 0, size - 1);
      float reached = gBuffers.maps.data[first + uint(row * size + column)];
      if (!(place.distance - bias > reached)) lit += 1.0f;
    }
  }
  return lit / float((2 * radius + 1) * (2 * radius + 1));
}
