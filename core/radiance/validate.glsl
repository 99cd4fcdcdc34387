// A pass over groups of cells: does the path that the cell whose turn it is keeps still find what
// it found? The same random numbers lead it along the same way, so what differs is the light of the
// scene, not noise. A cell whose light is another begins anew (counted). Reservoirs are validated
// so by Ouyang et al. 2021.
#include "core/radiance/path_from.glsl"
#include "core/radiance/turn.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint cell = radianceDue(row.y * RL_ENTRY_ROW + row.x);
  if (cell >= gParams.entries.count) return;
  // Cells that no point belongs to any more wait until one does.
  if (gBuffers.seen.data[cell] + RL_RADIANCE_RECENT < gFrame.frame) return;
  uint at = cell * RL_RADIANCE_KEPT_QUADS;
  uvec4 from = RL_PAST_QUAD(gBuffers.kept, at);
  if (from.w == 0u) return;
  uvec4 to = RL_PAST_QUAD(gBuffers.kept, at + 1u);
  uvec4 found = RL_PAST_QUAD(gBuffers.kept, at + 2u);
  vec3 before = recordVec3(found);
  vec3 now = radianceOfPath(radiancePathFrom(from, to, found.w, to.w));
  // Rounding may differ from that of the pass that traced it first.
  float tolerance = RL_RADIANCE_SAME * (rlMax3(before) + rlMax3(now));
  if (!rlIsFinite3(now) || distance(before, now) <= tolerance) return;
  RL_HEALTH(RL_HEALTH_LIGHT_CHANGED);
  // With nothing: the kept path was chosen for its light, and no mean may begin with it.
  RL_WRITE_QUAD(gBuffers.cells.light, cell, uvec4(0u, 0u, 0u, 0u));
  RL_WRITE_QUAD(gBuffers.kept, at + 2u, recordQuad(now, found.w));
}
