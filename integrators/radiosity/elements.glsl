// Pass over elements, once a scene: the mean albedo.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint element = row.y * RL_ENTRY_ROW + row.x;
  if (element >= gParams.elements) return;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < RL_RADIOSITY_POINTS; i = i + 1u) {
    SurfaceId id = meshPoint(element, meshFixedPoint(i));
    Surface s = surfaceLoad(meshHit(id), -surfacePointAt(id).normalW);
    sum += min(bsdfAlbedo(s.bsdf), vec3(1.0f, 1.0f, 1.0f));
  }
  gBuffers.albedo.data[element] = sum * (1.0f / float(RL_RADIOSITY_POINTS));
}
