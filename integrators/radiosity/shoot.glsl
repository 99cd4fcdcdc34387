// Pass over unknowns: takes what the chosen sides of elements send. Factors are computed anew, so
// that none are kept.
#include "integrators/radiosity/visible_factor.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint unknown = row.y * RL_ENTRY_ROW + row.x;
  if (solveIsDone() || unknown >= gParams.unknowns) return;
  Surface at = meshUnknown(unknown);
  vec3 sum = vec3(0.0f, 0.0f, 0.0f);
  for (uint shot = 0u; shot < gParams.shots; shot = shot + 1u) {
    uvec4 chosen = RL_EARLIER_UVEC4(gBuffers.chosen, shot);
    uint side = chosen.w;
    if (side == RL_INVALID) continue;
    uint seen;
    float factor = visibleFactor(at, side / 2u, seen);
    if (seen == side) sum += recordVec3(chosen) * factor;
  }
  gBuffers.irradiance.data[unknown] += sum;
  gBuffers.change.data[unknown] = rlLuminance(abs(sum));
}
