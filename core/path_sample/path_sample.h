// Path sample of a reservoir: a film sample, and the light that the first vertex x1 receives. x1
// itself is not stored: the ray through the film sample finds it, in this pixel or in another.
#ifndef RL_PATH_SAMPLE_H
#define RL_PATH_SAMPLE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"

RL_NAMESPACE_BEGIN

// Kinds of paths. Each is a domain of its own: no shift leads from one to another.
const uint RL_PATH_DIRECT = 0u;        // x1 lit by a point of a light or by a direction
const uint RL_PATH_LAMBERT = 1u;       // Lambert x2: `radiance` leaves x2 in every direction
const uint RL_PATH_LIGHT = 2u;         // glossy x2, lit by a light sample from suffix.wi
const uint RL_PATH_CONTINUATION = 3u;  // glossy x2, path continues in direction suffix.wi

// Data to evaluate a glossy x2 for another direction.
struct PathSuffix {
  vec3 nShadeW;
  float pdfLight;  // solid-angle density of light sampling for wi at x2; 0: no competing technique
  vec3 wi;
  vec3 emitted;  // continuation: emission found at x3, before its MIS weight
  Bsdf bsdf;
};

struct PathSample {
  vec3 posW;       // x2 or the light; a unit direction if the light is at infinity
  float posError;  // metres
  vec3 normalW;    // x2: geometric, unit, on the side of x1; light: as LightSample::normal
  uint kind;       // RL_PATH_*; light: plus RL_LIGHT_* << 2 and RL_PATH_TWO_SIDED; 8 bits
  vec3 radiance;   // x2: sent towards x1, or incident (suffix); light: LightSample::radiance
  uint film;       // the film sample: cameraFilmBits()
  uint light;      // spot light: LightSample::record, which has axis and cone
  float geometry;  // x2: |cos| / d^2 towards x1 of the pixel that holds it; light: 0
  PathSuffix suffix;
};

const uint RL_PATH_KIND_MASK = 3u;
const uint RL_PATH_LIGHT_SHIFT = 2u;
const uint RL_PATH_LIGHT_MASK = 7u;
const uint RL_PATH_TWO_SIDED = 0x20u;

// In the kernels' gParams.path.
struct PathParams {
  uint lightCandidates;  // light samples at x1, of which one is kept
  float minAlpha;        // GGX alpha below which x1 is not reused
  float maxJacobian;     // shifts outside [1/x, x] are undefined, both ways (Lin et al. 2022)
};

struct PathReservoir {
  PathSample path;
  ReservoirState state;
};

// Number of uvec4s in a buffer: of the sample (its radiance is stored with the state), of sample
// and state, and of the suffix, which has a buffer of its own.
const uint RL_PATH_SAMPLE_UVEC4S = 2u;
const uint RL_PATH_RESERVOIR_UVEC4S = RL_PATH_SAMPLE_UVEC4S + RL_STATE_UVEC4S;
const uint RL_PATH_SUFFIX_UVEC4S = 1u + RL_BSDF_UVEC4S;

RL_NAMESPACE_END

#endif
