// Pass over groups: traces the ray that a pixel asked for in the last frame, and a path from its
// hit.
#include "core/radiance_cache/path_from.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  if (group * gParams.cells.every >= gFrame.width * gFrame.height) return;
  uvec4 from = RL_PAST_QUAD(gBuffers.cells.rays, group * RL_RADIANCE_RAY_QUADS);
  uvec4 to = RL_PAST_QUAD(gBuffers.cells.rays, group * RL_RADIANCE_RAY_QUADS + 1u);
  RadianceTrace state = radiancePathFrom(from, to, group, gFrame.frame);
  vec3 light = radianceOfPath(state);
  if (!rlIsFinite3(light)) {
    RL_HEALTH(RL_HEALTH_NONFINITE);
    state.posError = -1.0f;
  }
  uint at = group * RL_RADIANCE_POINT_QUADS;
  RL_WRITE_QUAD(gBuffers.points, at, recordQuad(state.posW, packNormal(state.nGeoW)));
  RL_WRITE_QUAD(gBuffers.points, at + 1u, recordQuad(light, floatBitsToUint(state.posError)));
}
