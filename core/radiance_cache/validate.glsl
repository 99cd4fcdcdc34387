// Pass over groups of cells: traces again the kept path of the cell whose turn it is, and compares
// the light. The random numbers are the same, so a difference is a change of the scene's light, not
// noise. A cell whose light changed is reset (counted). Ouyang et al. 2021 validate reservoirs in
// this way.
#include "core/radiance_cache/path_from.glsl"
#include "core/radiance_cache/round_robin.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint cell = radianceDue(row.y * RL_ENTRY_ROW + row.x);
  if (cell >= gParams.entries.count) return;
  // Cells that no point belongs to any more wait until one does.
  if (gBuffers.seen.data[cell] + RL_RADIANCE_RECENT < gFrame.frame) return;
  uint at = cell * RL_RADIANCE_KEPT_UVEC4S;
  uvec4 from = RL_EARLIER_UVEC4(gBuffers.kept, at);
  if (from.w == 0u) return;
  uvec4 to = RL_EARLIER_UVEC4(gBuffers.kept, at + 1u);
  uvec4 found = RL_EARLIER_UVEC4(gBuffers.kept, at + 2u);
  vec3 before = recordVec3(found);
  vec3 now = radianceOfPath(radiancePathFrom(from, to, found.w, to.w));
  // Rounding may differ from that of the pass that traced the path first.
  float tolerance = RL_RADIANCE_SAME * (rlMax3(before) + rlMax3(now));
  if (!rlIsFinite3(now) || distance(before, now) <= tolerance) return;
  RL_HEALTH(RL_HEALTH_LIGHT_CHANGED);
  // Reset to nothing: the kept path was chosen for its light, so the mean must not begin with it.
  RL_WRITE_UVEC4(gBuffers.cells.light, cell, uvec4(0u, 0u, 0u, 0u));
  RL_WRITE_UVEC4(gBuffers.kept, at + 2u, recordUvec4(now, found.w));
}
