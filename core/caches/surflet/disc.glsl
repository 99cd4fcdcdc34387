// The surflet cache: discs on surfaces, each with an entry. The radius of a disc is a number of
// pixels where the disc was spawned. Discs are spawned where no disc covers the surface that a
// pixel shows. A hash grid, whose cells are about as wide as a disc's radius, finds discs by the
// cell of their centre.
#include "core/caches/entries/entries.glsl"
#include "core/caches/entries/grid.glsl"
#include "core/caches/entries/least_recently_seen.glsl"
#include "core/caches/entries/pixel_queries.glsl"

RL_FN float discRadius(RL_IN(GBufferTexel) s) { return gParams.discPixels * gridPixel(s.posW); }
RL_FN uint entryLevel(RL_IN(GBufferTexel) s) { return gridLevel(discRadius(s)); }
RL_FN float entrySpread(RL_IN(GBufferTexel) s) { return gParams.entries.spread * discRadius(s); }
RL_FN uvec2 entryWanted(RL_IN(GBufferTexel) s) {
  return gridKey(s.posW, entryLevel(s), gridOctant(unpackNormal(s.nGeoW)));
}
RL_FN void entryBegin(uint entry, RL_IN(uvec2) key, RL_IN(GBufferTexel) s) {
  gridTake(gBuffers.keys, entry, key);
  ShadingPoint disc;
  disc.surface = s;
  disc.posError = discRadius(s);
  disc.sourcePixel = RL_INVALID;
  shadingPointWrite(gBuffers.discs, entry, disc);
  shadingPointWrite(gBuffers.shadingPoints, entry, shadingPointNone());
}

// Distance to a disc's centre, scaled at random per disc by up to 5 %: pixels lie in rows, and
// where many are equally far from two discs rounding would decide.
RL_FN float discDistance(uint entry, RL_IN(ShadingPoint) disc, RL_IN(vec3) posW) {
  float own = float(rngHash(entry) >> 8u) * 5.9604644775390625e-8f;
  return distance(disc.surface.posW, posW) * (0.95f + 0.1f * own);
}

// Disc with the nearest centre, of those that cover a point and lie on a surface similar to the one
// that the pixel shows. Searches the four cells around the point on its tangent plane.
RL_FN uint discCovering(RL_IN(GBufferTexel) here, RL_IN(vec3) posW, uint level) {
  uint best = RL_INVALID;
  float least = 0.0f;
  vec3 normalW = unpackNormal(here.nGeoW);
  float side = gridSide(level);
  uint octant = gridOctant(normalW);
  for (uint i = 0u; i < 4u; i = i + 1u) {
    vec3 offset = vec3((float(i % 2u) - 0.5f) * side, (float(i / 2u) - 0.5f) * side, 0.0f);
    uint entry = gridFind(gParams.grid, gBuffers.keys,
                          gridKey(posW + frameToWorld(normalW, offset), level, octant));
    if (entry == RL_INVALID || entry == best) continue;
    ShadingPoint disc = shadingPointRead(gBuffers.discs, entry);
    float d = discDistance(entry, disc, posW);
    if (disc.posError < d || (best != RL_INVALID && least <= d)) continue;
    if (!gbufferIsSimilar(here, disc.surface, gParams.similarity)) continue;
    best = entry;
    least = d;
  }
  return best;
}

// Entry of a surface: the disc that covers it, or else the disc of its cell, which has at most one.
RL_FN uint entryOwn(RL_IN(GBufferTexel) s) {
  uint entry = discCovering(s, s.posW, entryLevel(s));
  if (entry == RL_INVALID) entry = gridFind(gParams.grid, gBuffers.keys, entryWanted(s));
  return entry;
}
RL_FN uint entryNear(RL_IN(GBufferTexel) here, RL_IN(vec3) posW, uint level) {
  return discCovering(here, posW, level);
}
