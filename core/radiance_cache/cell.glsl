// Radiance cells as entries of a cache. Queries are points: hits of the rays of the last
// frame, at most one per group of pixels.
#include "core/caches/entries/groups.glsl"
#include "core/radiance_cache/key.glsl"
#include "core/caches/entries/least_recently_seen.glsl"

RL_FN uint entryQuery(RL_IN(uvec2) row) {
  uint group = row.y * RL_ENTRY_ROW + row.x;
  uint pixels = gFrame.width * gFrame.height;
  return group * gParams.cells.every < pixels ? group : RL_INVALID;
}

RL_FN GBufferTexel entryVisible(uint group) {
  uvec4 q0 = RL_EARLIER_UVEC4(gBuffers.points, group * RL_RADIANCE_POINT_UVEC4S);
  uvec4 q1 = RL_EARLIER_UVEC4(gBuffers.points, group * RL_RADIANCE_POINT_UVEC4S + 1u);
  GBufferTexel s;
  s.posW = recordVec3(q0);
  s.isHit = uintBitsToFloat(q1.w) < 0.0f ? 0u : 1u;
  s.emits = 0u;
  s.isMirror = 0u;
  s.nGeoW = q0.w;
  s.nShadeW = q0.w;
  s.reflectance = vec3(0.0f, 0.0f, 0.0f);
  return s;
}

RL_FN uvec2 entryWanted(RL_IN(GBufferTexel) s) {
  return radianceKey(gParams.cells, s.posW, unpackNormal(s.nGeoW));
}
RL_FN uint entryOwn(RL_IN(GBufferTexel) s) {
  return gridFind(gParams.grid, gBuffers.cells.keys, entryWanted(s));
}
RL_FN void entryBegin(uint cell, RL_IN(uvec2) key, RL_IN(GBufferTexel) s) {
  gridTake(gBuffers.cells.keys, cell, key);
  vec3 place = radiancePlace(gParams.cells, s.posW, unpackNormal(s.nGeoW));
  RL_WRITE_UVEC4(gBuffers.cells.places, cell, recordUvec4(place, s.nGeoW));
  RL_WRITE_UVEC4(gBuffers.cells.light, cell, uvec4(0u, 0u, 0u, 0u));
  RL_WRITE_UVEC4(gBuffers.kept, cell * RL_RADIANCE_KEPT_UVEC4S, uvec4(0u, 0u, 0u, 0u));
}
