// The voxel cache: a cell of the grid and an octant of normals share one entry.
#include "core/caches/entries/entries.glsl"
#include "core/caches/entries/grid.glsl"

RL_FN uint entryLevel(RL_IN(VisibleSurface) s) {
  return gridLevel(gParams.cellPixels * gridPixel(s));
}
RL_FN float entrySpread(RL_IN(VisibleSurface) s) {
  return gParams.grid.spread * gridSide(entryLevel(s));
}
RL_FN uvec2 entryWanted(RL_IN(VisibleSurface) s) {
  return gridKey(s.posW, entryLevel(s), gridOctant(unpackNormal(s.nGeoW)));
}
RL_FN uint entryOwn(RL_IN(VisibleSurface) s) { return gridFind(entryWanted(s)); }
RL_FN void entryBegin(uint entry, RL_IN(VisibleSurface) s) {}
// The entry of a cell, where its anchor is like what the pixel shows.
RL_FN uint entryNear(RL_IN(VisibleSurface) here, RL_IN(vec3) posW, uint level) {
  uint entry = gridFind(gridKey(posW, level, gridOctant(unpackNormal(here.nGeoW))));
  if (entry == RL_INVALID) return RL_INVALID;
  if (!visibleAlike(here, anchorRead(gBuffers.anchors, entry).surface, gParams.alike))
    return RL_INVALID;
  return entry;
}
