// Pass over groups: traces the ray that a pixel asked for in the last frame, and a path from its
// hit.
#include "core/radiance_cache/path_from.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  if (group * gParams.cells.every >= gFrame.width * gFrame.height) return;
  uvec4 from = RL_EARLIER_UVEC4(gBuffers.cells.rays, group * RL_RADIANCE_RAY_UVEC4S);
  uvec4 to = RL_EARLIER_UVEC4(gBuffers.cells.rays, group * RL_RADIANCE_RAY_UVEC4S + 1u);
  RadianceTrace state = radiancePathFrom(from, to, group, gFrame.frame);
  vec3 light = radianceOfPath(state);
  if (!rlIsFinite3(light)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    state.posError = -1.0f;
  }
  uint at = group * RL_RADIANCE_POINT_UVEC4S;
  RL_WRITE_UVEC4(gBuffers.points, at, recordUvec4(state.posW, packNormal(state.nGeoW)));
  RL_WRITE_UVEC4(gBuffers.points, at + 1u, recordUvec4(light, floatBitsToUint(state.posError)));
}
