// Hash key of a point's cell, and whether the point belongs to the cell.
#include "core/caches/entries/grid.glsl"

RL_FN float radianceSide(RL_IN(RadianceParams) cells, RL_IN(vec3) posW) {
  return gridSide(gridLevel(cells.cellPixels * gridPixel(posW)));
}

RL_FN uvec2 radianceKey(RL_IN(RadianceParams) cells, RL_IN(vec3) posW, RL_IN(vec3) nGeoW) {
  return gridKey(posW, gridLevel(cells.cellPixels * gridPixel(posW)), gridOctant(nGeoW));
}

// Viewpoint of a cell: a quarter of its side over the point that began it. Points belong to the
// cell only if they see the viewpoint, so no cell reaches through a wall, however thin.
RL_FN vec3 radiancePlace(RL_IN(RadianceParams) cells, RL_IN(vec3) posW, RL_IN(vec3) nGeoW) {
  return posW + nGeoW * (0.25f * radianceSide(cells, posW));
}

RL_FN bool radianceFaces(RL_IN(uvec4) place, RL_IN(vec3) nGeoW) {
  return dot(unpackNormal(place.w), nGeoW) >= RL_RADIANCE_MIN_DOT;
}

// Traces a ray from a surface point to the cell's viewpoint; returns whether the way is free.
RL_FN bool radianceSees(RL_IN(uvec4) place, RL_IN(vec3) posW, RL_IN(vec3) nGeoW, float posError) {
  vec3 to = recordVec3(place);
  Ray ray;
  ray.origin = surfaceOffset(posW, nGeoW, posError, to - posW);
  ray.dir = to - ray.origin;
  ray.tMin = 0.0f;
  ray.tMax = 1.0f;
  if (!(dot(ray.dir, nGeoW) > 0.0f)) return false;
  Hit hit;
  return traceRay(ray, RL_RAY_SHADOW, 0u, hit) > 0.99f;
}
