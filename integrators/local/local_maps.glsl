// local_maps: draws the shadow maps, a ray a texel. Partly transparent surfaces are there or not,
// by a hash of the texel. Rays pass the surfaces of their own lamp.

#include "integrators/local/shadow_map.glsl"

RL_FN void kernelMain(RL_IN(uvec2) entry) {
  uint texel = entry.y * RL_ENTRY_ROW + entry.x;
  uint perSquare = gParams.mapSize * gParams.mapSize;
  uint square = texel / perSquare;
  if (square >= gParams.mapSquares) return;
  uint count = localLampCount();
  uint index = RL_INVALID;
  for (uint i = 0u; i < count; i = i + 1u) {
    uvec4 q = RL_EARLIER_UVEC4(gBuffers.lamps, 1u + i * RL_LOCAL_LAMP_UVEC4S + 2u);
    if (q.z <= square) index = i;
  }
  if (index == RL_INVALID) return;  // no lamp has this square
  LocalLamp lamp = localLampRead(index);
  square = square - lamp.firstSquare;
  if (square >= localMapSquares(lamp.shape)) return;
  uint place = texel % perSquare;
  vec2 uv = vec2(float(place % gParams.mapSize) + 0.5f, float(place / gParams.mapSize) + 0.5f);
  uv = uv * (2.0f / float(gParams.mapSize)) - vec2(1.0f, 1.0f);
  Ray ray = localMapRay(lamp, square, uv);
  float reached = 3.0e38f;
  for (uint own = 0u; own < RL_LOCAL_MOST_OWN; own = own + 1u) {
    Hit hit = traceNoHit();
    traceRay(ray, RL_RAY_PATH, texel, hit);
    if (hit.instance == RL_INVALID) break;
    if (lamp.isArea == 0u || hit.instance != lamp.key) {
      reached = hit.t;
      break;
    }
    float scale = max(rlMax3(abs(ray.origin)), hit.t);
    ray.tMin = max(hit.t, ray.tMin) + 4.0f * RL_HIT_ERROR * scale;
  }
  gBuffers.maps.data[texel] = reached;
}
