// Form factor with visibility: Lambert's formula times the share of rays that arrive, from a point
// to fixed points of the element. All rays of a kernel leave from here.
#include "integrators/radiosity/mesh.glsl"
#include "integrators/radiosity/form_factor.glsl"

// Returns the factor of the side `element * 2 + side`; 0: it is not seen from there.
RL_FN float visibleFactor(RL_IN(Surface) from, uint element, RL_OUT(uint) side) {
  side = 2u * element;
  SurfacePoint a = surfacePointAt(meshPoint(element, vec2(0.0f, 0.0f)));
  SurfacePoint b = surfacePointAt(meshPoint(element, vec2(1.0f, 0.0f)));
  SurfacePoint c = surfacePointAt(meshPoint(element, vec2(0.0f, 1.0f)));
  vec3 toA = a.posW - from.posW;
  vec3 toB = b.posW - from.posW;
  vec3 toC = c.posW - from.posW;
  float distance = dot(a.normalW, toA);
  if (abs(distance) <= 2.0f * (from.posError + a.posError)) return 0.0f;
  side += distance < 0.0f ? 0u : 1u;
  float factor = formFactorOfTriangle(from.nShadeW, toA, toB, toC);
  if (!(factor > 0.0f)) return 0.0f;
  float arrived = 0.0f;
  float above = 0.0f;
  for (uint i = 0u; i < RL_RADIOSITY_POINTS; i = i + 1u) {
    vec2 w = meshFixedPoint(i);
    vec3 target = a.posW + (b.posW - a.posW) * w.x + (c.posW - a.posW) * w.y;
    vec3 dirW = normalize(target - from.posW);
    if (!(dot(dirW, from.nShadeW) > 0.0f)) continue;
    above += 1.0f;
    if (!(dot(dirW, from.nGeoW) > 0.0f)) continue;
    Ray ray;
    ray.origin = surfaceOffset(from.posW, from.nGeoW, from.posError, dirW);
    ray.dir = surfaceSegmentEnd(target, a.normalW, a.posError, from.posError, -dirW) - ray.origin;
    ray.tMin = 0.0f;
    ray.tMax = 1.0f;
    Hit hit = traceNoHit();
    float passed = traceRay(ray, RL_RAY_SHADOW, 0u, hit);
    // Rays end before the element: its own coverage is counted here.
    if (RL_HAS(RL_FEATURE_ALPHA) && passed > 0.0f)
      passed *= surfaceAlpha(meshHit(meshPoint(element, w)));
    arrived += passed;
  }
  // An element at the horizon may have no point above it: nobody knows what hides the rest, and it
  // counts as hidden.
  return above > 0.0f ? factor * (arrived / above) : 0.0f;
}
