// Pass over unknowns and sides of elements, once for the light of a scene: the solution begins with
// the light of the sources.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint entry = row.y * RL_ENTRY_ROW + row.x;
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  if (entry == 0u) {
    for (uint i = 0u; i < RL_RADIOSITY_STATE_WORDS; i = i + 1u) gBuffers.state.data[i] = 0u;
  }
  if (entry < 2u * gParams.elements && !RL_IS_NULL(gBuffers.shot)) gBuffers.shot.data[entry] = sum;
  if (entry >= gParams.unknowns) return;
  for (uint i = 0u; i < gParams.lightChunks; i = i + 1u)
    sum += gBuffers.directParts.data[entry * gParams.lightChunks + i];
  gBuffers.source.data[entry] = sum;
  gBuffers.irradiance.data[entry] = sum;
  gBuffers.change.data[entry] = rlLuminance(sum);
}
