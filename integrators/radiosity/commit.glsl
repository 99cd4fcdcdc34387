// Pass over groups of the unknowns of a set: takes their new values and sums how much they change.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  if (solveIsDone() || group >= gParams.groups) return;
  float changed = 0.0f;
  float light = 0.0f;
  for (uint i = 0u; i < RL_RADIOSITY_GROUP; i = i + 1u) {
    uint entry = group * RL_RADIOSITY_GROUP + i;
    uint unknown = entry * gParams.sets + gBuffers.state.data[RL_RADIOSITY_SET];
    if (unknown >= gParams.unknowns) break;
    float area = meshUnknownArea(unknown);
    vec3 next = gBuffers.pending.data[unknown];
    float change = rlLuminance(abs(next - gBuffers.irradiance.data[unknown]));
    gBuffers.change.data[unknown] = change;
    gBuffers.irradiance.data[unknown] = next;
    changed += area * change;
    light += area * rlLuminance(gBuffers.source.data[unknown]);
  }
  gBuffers.parts.data[group] = vec2(changed, light);
}
