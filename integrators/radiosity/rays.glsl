// Pass over chunks of the rays of an unknown, once a scene: its row of the system by rays. They are
// cosine-weighted about its normal, one in each stratum of the square; each of n rays is a form
// factor of 1/n.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  uint rays = gParams.raysPerSide * gParams.raysPerSide;
  uint chunks = (rays + RL_RADIOSITY_CHUNK - 1u) / RL_RADIOSITY_CHUNK;
  uint unknown = entry / chunks;
  if (unknown >= gParams.unknowns) return;
  Surface from = meshUnknown(unknown);
  Rng rng = rngInit(gFrame.seed, unknown, 0u);
  uint first = (entry % chunks) * RL_RADIOSITY_CHUNK;
  uint end = RL_LESSER(first + RL_RADIOSITY_CHUNK, rays);
  float step = 1.0f / float(gParams.raysPerSide);
  for (uint i = first; i < end; i = i + 1u) {
    Rng own = rng;
    own.vertex = RL_VERTEX_CANDIDATES + i;
    float u = rngDraw(own, RL_DIM_BSDF_U);
    float v = rngDraw(own, RL_DIM_BSDF_V);
    vec2 at = vec2(float(i % gParams.raysPerSide), float(i / gParams.raysPerSide));
    Ray ray;
    ray.dir = frameToWorld(from.nShadeW, warpCosineHemisphere((at + vec2(u, v)) * step));
    ray.origin = surfaceOffset(from.posW, from.nGeoW, from.posError, ray.dir);
    ray.tMin = 0.0f;
    ray.tMax = 3.0e38f;
    Hit hit = traceNoHit();
    // A smooth normal's hemisphere reaches below the face.
    if (dot(ray.dir, from.nGeoW) > 0.0f)
      traceRay(ray, RL_RAY_PATH, rngHash(own.key.x + i * 0x632be59bu), hit);
    uint word = 2u * (unknown * rays + i);
    gBuffers.hits.data[word] = RL_INVALID;
    gBuffers.hits.data[word + 1u] = 0u;
    if (hit.instance == RL_INVALID) continue;
    SurfaceId id;
    id.instance = hit.instance;
    id.primitive = hit.primitive;
    id.bary = hit.bary;
    ElementPlace place = meshPlace(id);
    gBuffers.hits.data[word] =
        2u * place.element + meshSideSeen(surfacePointAt(id).normalW, ray.dir);
    gBuffers.hits.data[word + 1u] =
        uint(place.weights.y * 65535.0f + 0.5f) | (uint(place.weights.z * 65535.0f + 0.5f) << 16u);
  }
}
