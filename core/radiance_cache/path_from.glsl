// Traces a path from the hit of a ray to its end. The path ends in no cell, because it would miss
// the light that the cell misses. The same ray, group and frame give the same path.
#define RL_WALK_STATE RadianceTrace

RL_FN uint onVertex(RL_INOUT(RadianceTrace) state, RL_IN(Walk) walk, RL_INOUT(Surface) s) {
  if (state.hasPoint != 0u) return 1u;
  if (!bsdfIsReusable(s.bsdf, gParams.cells.minAlpha)) return RL_WALK_ENDS;
  // A surface that does not reflect a colour says nothing about light of that colour.
  vec3 reflectance = bsdfReflectance(s.bsdf);
  if (!(min(reflectance.x, min(reflectance.y, reflectance.z)) > 0.0f)) return RL_WALK_ENDS;
  state.hasPoint = 1u;
  state.sum.radiance = vec3(0.0f, 0.0f, 0.0f);  // cells do not hold the point's emission
  state.posW = s.posW;
  state.nGeoW = s.nGeoW;
  state.posError = s.posError;
  state.reflectance = reflectance;
  return 1u;
}

#include "core/transport/light_sum.glsl"

// `from`, `to`: as in RadianceBuffers::rays.
RL_FN RadianceTrace radiancePathFrom(RL_IN(uvec4) from, RL_IN(uvec4) to, uint group, uint frame) {
  RadianceTrace state;
  state.sum = lightSumNone();
  state.posW = vec3(0.0f, 0.0f, 0.0f);
  state.nGeoW = vec3(0.0f, 0.0f, 1.0f);
  state.reflectance = state.posW;
  state.posError = -1.0f;
  state.hasPoint = 0u;
  if (from.w == 0u) return state;
  Ray ray;
  ray.origin = recordVec3(from);
  ray.dir = recordVec3(to);
  ray.tMin = 0.0f;
  ray.tMax = 3.0e38f;
  Walk walk = walkBegin(rngInit(gFrame.seed ^ 0x1b873593u, group, frame), 0u, ray, from.w);
  walk.rouletteStart = min(walk.rouletteStart, RL_ROULETTE_EARLIEST);
  walkOn(state, walk);
  return state;
}

// Value stored in cells: the light that left the point over its reflectance.
RL_FN vec3 radianceOfPath(RL_IN(RadianceTrace) state) {
  return vec3(rlSafeDivide(state.sum.radiance.x, state.reflectance.x),
              rlSafeDivide(state.sum.radiance.y, state.reflectance.y),
              rlSafeDivide(state.sum.radiance.z, state.reflectance.z));
}
