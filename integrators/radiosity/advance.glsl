// Pass of one entry: ends a set of unknowns, or an iteration, and decides whether it was the last.
// The residual is the light that changed (Jacobi, Gauss-Seidel) or was not sent yet (Southwell)
// over the light of the sources, both by area.
#include "integrators/radiosity/mesh.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  if (row.x + row.y != 0u || solveIsDone()) return;
  float changed = uintBitsToFloat(gBuffers.state.data[RL_RADIOSITY_CHANGE]);
  float scale = uintBitsToFloat(gBuffers.state.data[RL_RADIOSITY_SCALE]);
  uint done = gBuffers.state.data[RL_RADIOSITY_ITERATIONS];
  bool isSouthwell = gParams.solver == RL_RADIOSITY_SOUTHWELL;
  // Southwell's scale is what there was to send at first.
  for (uint i = 0u; i < gParams.groups; i = i + 1u) {
    vec2 part = gBuffers.parts.data[i];
    changed += part.x;
    if (isSouthwell)
      scale += done == 0u ? part.x : 0.0f;
    else
      scale += done == 0u ? part.y : 0.0f;
  }
  gBuffers.state.data[RL_RADIOSITY_CHANGE] = floatBitsToUint(changed);
  gBuffers.state.data[RL_RADIOSITY_SCALE] = floatBitsToUint(scale);
  uint next = gBuffers.state.data[RL_RADIOSITY_SET] + 1u;
  if (next < gParams.sets) {
    gBuffers.state.data[RL_RADIOSITY_SET] = next;
    return;
  }
  float residual = rlSafeDivide(changed, scale);
  if (!rlIsFinite(residual)) RL_HEALTH(RL_HEALTH_NONFINITE);
  gBuffers.residuals.data[done] = residual;
  done = done + 1u;
  gBuffers.state.data[RL_RADIOSITY_SET] = 0u;
  gBuffers.state.data[RL_RADIOSITY_CHANGE] = 0u;
  gBuffers.state.data[RL_RADIOSITY_ITERATIONS] = done;
  // Only Jacobi's iterations are scattering events.
  bool isJacobi = gParams.sets == 1u && !isSouthwell;
  bool isLast = done >= gParams.iterations || (isJacobi && done + 1u >= gFrame.maxBounces);
  if (isLast || !(residual > gParams.tolerance)) gBuffers.state.data[RL_RADIOSITY_IS_SOLVED] = 1u;
}
