// Pass over groups: selects which groups' light goes into which cell.
#include "core/radiance_cache/cell.glsl"

RL_FN void kernelMain(RL_IN(uvec2) row) {
  uint group = entryQuery(row);
  if (group == RL_INVALID) return;
  GBufferTexel point = entryVisible(group);
  if (point.isHit == 0u) return;
  uint cell = gBuffers.entries.data[group];
  if (cell >= RL_GRID_CLAIM) {
    RL_HEALTH(RL_HEALTH_CACHE_FULL);
    return;
  }
  uvec4 place = RL_EARLIER_UVEC4(gBuffers.cells.places, cell);
  vec3 nGeoW = unpackNormal(point.nGeoW);
  if (!radianceFaces(place, nGeoW)) return;
  uvec4 q1 = RL_EARLIER_UVEC4(gBuffers.points, group * RL_RADIANCE_POINT_UVEC4S + 1u);
  if (radianceSees(place, point.posW, nGeoW, uintBitsToFloat(q1.w)))
    groupInserts(gBuffers.insertions, cell, group);
}
