// Pass over the unknowns of a set: E = source + sum of F albedo E. With one set this is Jacobi's
// iteration, which adds one scattering event; with several, block Gauss-Seidel: a set sees what
// those before it have become.
#include "integrators/radiosity/mesh.glsl"

RL_FN vec3 gatherByRays(uint unknown) {
  uint rays = gParams.raysPerSide * gParams.raysPerSide;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < rays; i = i + 1u) {
    uint word = 2u * (unknown * rays + i);
    uint side = gBuffers.hits.data[word];
    if (side == RL_INVALID) continue;
    uint packed = gBuffers.hits.data[word + 1u];
    float v = float(packed & 0xffffu) * (1.0f / 65535.0f);
    float w = float(packed >> 16u) * (1.0f / 65535.0f);
    sum += gBuffers.albedo.data[side / 2u] * meshIrradiance(side, vec3(1.0f - v - w, v, w));
  }
  return sum * (1.0f / float(rays));
}

RL_FN vec3 gatherByPolygons(uint unknown) {
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint element = 0u; element < gParams.elements; element = element + 1u) {
    float factor = gBuffers.factors.data[unknown * gParams.elements + element];
    if (factor == 0.0f) continue;
    uint side = 2u * element + (factor < 0.0f ? 1u : 0u);
    sum += gBuffers.albedo.data[element] * meshMeanIrradiance(side) * abs(factor);
  }
  return sum;
}

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  if (solveIsDone()) return;
  uint unknown = entry * gParams.sets + gBuffers.state.data[RL_RADIOSITY_SET];
  if (unknown >= gParams.unknowns) return;
  vec3 gathered = vec3(0.0f, 0.0f, 0.0f);
  if (gParams.usesPolygons != 0u)
    gathered = gatherByPolygons(unknown);
  else
    gathered = gatherByRays(unknown);
  gBuffers.pending.data[unknown] = gBuffers.source.data[unknown] + gathered;
}
