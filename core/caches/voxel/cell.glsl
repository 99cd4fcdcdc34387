// The voxel cache: a cell of the grid and an octant of normals share one entry.
#include "core/caches/entries/entries.glsl"
#include "core/caches/entries/grid.glsl"
#include "core/caches/entries/least_recently_seen.glsl"
#include "core/caches/entries/pixel_queries.glsl"

RL_FN uint entryLevel(RL_IN(GBufferTexel) s) {
  return gridLevel(gParams.cellPixels * gridPixel(s.posW));
}
RL_FN float entrySpread(RL_IN(GBufferTexel) s) {
  return gParams.entries.spread * gridSide(entryLevel(s));
}
RL_FN uvec2 entryWanted(RL_IN(GBufferTexel) s) {
  return gridKey(s.posW, entryLevel(s), gridOctant(unpackNormal(s.nGeoW)));
}
RL_FN uint entryOwn(RL_IN(GBufferTexel) s) {
  return gridFind(gParams.grid, gBuffers.keys, entryWanted(s));
}
RL_FN void entryBegin(uint entry, RL_IN(uvec2) key, RL_IN(GBufferTexel) s) {
  gridTake(gBuffers.keys, entry, key);
  shadingPointWrite(gBuffers.shadingPoints, entry, shadingPointNone());
}
RL_FN uint entryNear(RL_IN(GBufferTexel) here, RL_IN(vec3) posW, uint level) {
  uvec2 key = gridKey(posW, level, gridOctant(unpackNormal(here.nGeoW)));
  return gridFind(gParams.grid, gBuffers.keys, key);
}
