// Types, buffers and parameters of the `restir_gi` kernels.
#ifndef RL_RESTIR_GI_H
#define RL_RESTIR_GI_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// Where a pixel's samples are evaluated: its first hit, as stored for its neighbours and the next
// frame. The pixel itself shades with what it stored, so that a stored target is what anyone
// recomputes.
struct Anchor {
  vec3 posW;
  float posError;
  vec3 nGeoW;
  vec3 nShadeW;
  vec3 wo;
  uint isReusable;
  Bsdf bsdf;  // without transmission: such pixels are not reusable
};

// Direct light: a point of a light or a direction to the environment.
struct LightReservoir {
  LightSample light;
  ReservoirState state;
};

// Indirect light: the vertex x2 and what it sends towards x1.
const uint RL_PATH_LAMBERT = 0u;       // x2 is Lambert: `radiance` leaves it in every direction
const uint RL_PATH_LIGHT = 1u;         // glossy x2 lit by a light sample from suffix.wi
const uint RL_PATH_CONTINUATION = 2u;  // glossy x2, the path goes on in direction suffix.wi

struct PathVertex {
  vec3 posW;
  float posError;
  vec3 nGeoW;  // on the side of x1
  uint kind;
  vec3 radiance;
};

// What a glossy x2 needs to be evaluated for another direction.
struct PathSuffix {
  vec3 nShadeW;
  vec3 wi;
  vec3 emitted;    // continuation: emission found at x3, before its MIS weight
  float pdfLight;  // solid-angle density of light sampling for wi at x2; 0: no competing technique
  Bsdf bsdf;
};

struct PathReservoir {
  PathVertex vertex;
  PathSuffix suffix;
  ReservoirState state;
};

// What the initial pass keeps of the pixel's path (integrators/restir_gi/gather.glsl).
struct GiPath {
  vec3 ownLight;  // shaded as it is
  Anchor anchor;  // x1
  vec3 fX1;       // f |cos| at x1 towards x2
  float pdfX1;
  float passedX1;  // Walk::passed of the ray from x1

  // Direct light at x1.
  LightSample light;  // the light sample that was selected
  real lightSum;      // resampling weights of all light samples
  vec3 lightF;        // integrand of the selected one
  LightSample found;  // the light that the BSDF sample met
  vec3 foundF;
  real foundWeight;
  float foundCoverage;  // of the light that it met: what chance let it meet it

  // Indirect light: the path is cut at x2, `suffixThroughput` is that from x3 on.
  uint hasX2;  // a connectable x2 was found
  PathVertex x2;
  PathSuffix suffix;
  vec3 woX2;
  vec3 lightAtX2;  // light sample at x2 over its density, without BSDF and MIS weight at x2
  vec3 lightDirX2;
  float lightPdfX2;
  uint isSuffix;  // beyond x2, on the connectable part
  vec3 suffixThroughput;
  float pdfX2;    // of the continuation at x2
  vec3 weightX2;  // f |cos| / pdf of it
  vec3 dirX2;
  vec3 emittedAtX3;
  float pdfLightAtX3;
  vec3 rest;      // light beyond x3
  vec3 absorbed;  // transmittance up to the vertex under way
  vec3 unseen;    // of the last light sample, without its visibility
};

// Shadow rays of a round of shifts, traced by one call: light and path samples, each seen by
// another and seen here. A visibility of 1 stays where none is asked for.
const uint RL_GI_SEGMENTS = 4u;

struct GiSegments {
  Ray rays[RL_GI_SEGMENTS];
  uint asks[RL_GI_SEGMENTS];
  float visibility[RL_GI_SEGMENTS];
};

// What a slot has in the buffers, in quads of words (integrators/restir_gi/store.glsl). A
// reservoir's state is its last two quads.
const uint RL_GI_ANCHOR_QUADS = 4u;
const uint RL_GI_LIGHT_QUADS = 6u;
const uint RL_GI_PATH_QUADS = 5u;
const uint RL_GI_SUFFIX_QUADS = 6u;

struct RestirGiBuffers {
  Vec3Ref radiance;
  Vec3Ref ownLight;  // what is shaded by the pixel's own path: emission, unreusable parts
  QuadRef anchors;
  QuadRef previousAnchors;
  QuadRef anchorsGlossy;  // one quad: the rest of an anchor where the scene has glossy lobes
  QuadRef previousAnchorsGlossy;
  QuadRef lights;         // of this frame: initial, then temporal
  QuadRef lightsHistory;  // of the last frame; replaced by the spatial pass
  QuadRef paths;
  QuadRef pathsHistory;
  QuadRef suffixes;
  QuadRef suffixesHistory;
  // Between the temporal and the spatial pass, spatialNeighbours entries a pixel.
  UintRef partners;       // slots; RL_INVALID: none
  QuadRef shiftedLights;  // one quad: the pixel's sample as the partner sees it
  QuadRef shiftedPaths;
};

struct RestirGiParams {
  uint temporalFlags;  // RL_REUSE_*
  uint spatialFlags;
  uint lightCandidates;
  uint spatialNeighbours;
  uint spatialTile;    // pixels; side of the square within which pixels are paired
  uint temporalReuse;  // 0: off
  float confidenceCap;
  float minNormalDot;
  float maxPlaneDistance;     // relative to the distance from the camera
  float minAlpha;             // GGX alpha below which x1 is not reused
  float maxJacobian;          // shifts outside [1/x, x] are undefined, both ways
  float maxReflectanceRatio;  // per channel, of anchors, for the carried per-channel estimates
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RestirGiBuffers
#define RL_KERNEL_PARAMS RestirGiParams

#endif
