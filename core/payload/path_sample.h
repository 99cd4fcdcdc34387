// A path as reservoirs hold it: a film sample, and what its first vertex x1 receives. x1 itself is
// not kept: it is where the ray through the film sample ends, in this pixel or in another.
#ifndef RL_PATH_SAMPLE_H
#define RL_PATH_SAMPLE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"

RL_NAMESPACE_BEGIN

// Kinds of paths. Each is a domain of its own: no shift leads from one to another.
const uint RL_PATH_DIRECT = 0u;        // x1 lit by a point of a light or by a direction
const uint RL_PATH_LAMBERT = 1u;       // by a Lambert x2: `radiance` leaves it in every direction
const uint RL_PATH_LIGHT = 2u;         // by a glossy x2, which a light sample from suffix.wi lights
const uint RL_PATH_CONTINUATION = 3u;  // by a glossy x2, the path goes on in direction suffix.wi

// What a glossy x2 needs to be evaluated for another direction.
struct PathSuffix {
  vec3 nShadeW;
  float pdfLight;  // solid-angle density of light sampling for wi at x2; 0: no competing technique
  vec3 wi;
  vec3 emitted;  // continuation: emission found at x3, before its MIS weight
  Bsdf bsdf;
};

struct PathSample {
  vec3 posW;       // of x2 or of the light; a unit direction where the light is one
  float posError;  // metres
  vec3 normalW;    // x2: geometric, unit, on the side of x1; light: as LightSample::normal
  uint kind;       // RL_PATH_*, and of a light RL_LIGHT_* << 8 and RL_PATH_TWO_SIDED
  vec3 radiance;  // x2: sent towards x1, or what it reflects (suffix); light: LightSample::radiance
  uint film;      // the film sample: cameraFilmBits()
  vec3 cone;      // x, y: of a spot light, LightSample::cone
  float geometry;  // x2: |cos| / d^2 towards x1 of the pixel that holds it; light: 0
  PathSuffix suffix;
};

const uint RL_PATH_KIND_MASK = 0xffu;
const uint RL_PATH_LIGHT_SHIFT = 8u;
const uint RL_PATH_TWO_SIDED = 0x10000u;

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

// What lies in a buffer, quad by quad: three numbers and one more, a float (VF) or a uint (VU).
// Packing and unpacking are made of these lists.
#define RL_PATH_SAMPLE_FIELDS(VF, VU) \
  VF(0u, posW, posError)              \
  VU(1u, normalW, kind)               \
  VU(2u, radiance, film)              \
  VF(3u, cone, geometry)
// Three vectors and two numbers: one stands twice.
#define RL_PATH_SUFFIX_FIELDS(VF, VU)            \
  VF(0u, suffix.nShadeW, suffix.pdfLight)        \
  VF(1u, suffix.wi, RL_BSDF_SINGLE(suffix.bsdf)) \
  VF(2u, suffix.emitted, suffix.pdfLight)        \
  RL_BSDF_FIELDS(VF, VU, 3u, suffix.bsdf)
const uint RL_PATH_SAMPLE_QUADS = 4u;
const uint RL_PATH_SUFFIX_QUADS = 3u + RL_BSDF_QUADS;
// Sample and state; suffixes have a buffer of their own.
const uint RL_PATH_RESERVOIR_QUADS = RL_PATH_SAMPLE_QUADS + RL_STATE_QUADS;

RL_NAMESPACE_END

#endif
