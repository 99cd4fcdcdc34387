// State of a path while it is traced (core/transport/walk.glsl).
#ifndef RL_WALK_H
#define RL_WALK_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

struct Walk {
  Rng rng;          // rng.vertex is the current scattering event
  uint film;        // the film sample that the path begins with
  Ray ray;          // the next ray of the path
  uint bounces;     // scattering events before that ray
  vec3 throughput;  // up to the ray's origin: product of f |cos| / pdf of all events
  uvec4 media;      // bodies that the ray travels in (core/transport/media.glsl)
  vec3 sigma;       // m^-1, extinction of the medium that the ray travels in
  float passedT;    // metres travelled before the ray's origin, since the last real surface
  float
      pdfBsdf;  // solid-angle density of the ray; 0: camera or delta lobe, no light sample competes
  uint rouletteStart;  // first scattering event that may end the path by Russian roulette
  float passed;        // traceRay() of the ray: below 1 it may have passed something transparent
  uint isScattered;    // 1: the ray travels, since the last surface, in a medium that scatters
  uint stretches;      // number of stretches in such media so far; collisions are no `bounces`
  vec3 ofMedium;       // factors of such a medium since the last surface
  LightReceiver last;  // the last surface; with RL_FEATURE_SCATTERING, _LIGHT_TREE or shapes
  uint isAlive;        // 0: absorbed, or ended by Russian roulette
};

// Stretches in media that scatter, after which a path is ended and counted (RL_HEALTH_LONG_WALKS).
const uint RL_MOST_STRETCHES = 1023u;

// In place of the mean cosine of a medium that scatters: light leaves by a diffusion profile
// (core/transport/diffusion.glsl).
const float RL_PHASE_DIFFUSION = 2.0f;
// Largest distance to the point of exit that is searched, in units of the profile's scale; beyond,
// 3/4 exp(-24/3) of the light would leave.
const float RL_DIFFUSION_REACH = 24.0f;
// Surfaces that one search meets, of whatever thing; those beyond are left out.
const uint RL_DIFFUSION_HITS = 64u;

// Returned by onVertex() to end the path.
const uint RL_WALK_ENDS = 0xffffffffu;

RL_NAMESPACE_END

#endif
