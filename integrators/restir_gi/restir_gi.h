// Types, buffers and parameters of the `restir_gi` kernels.
#ifndef RL_RESTIR_GI_H
#define RL_RESTIR_GI_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"

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

struct StoredAnchor {
  vec3 posW;
  float posError;
  vec3 nGeoW;
  uint isReusable;
  vec3 nShadeW;
  vec3 diffuse;
};
RL_STATIC_ASSERT_SIZE(StoredAnchor, 56);

// The rest of an anchor where the scene has glossy lobes.
struct StoredAnchorGlossy {
  vec3 f0;
  float f90;
  float alpha;
  uint lobes;
};
RL_STATIC_ASSERT_SIZE(StoredAnchorGlossy, 24);

// Direct light: a point of a light or a direction to the environment.
struct LightReservoir {
  LightSample light;
  ReservoirState state;
};
RL_STATIC_ASSERT_SIZE(LightReservoir, 92);

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
  ReservoirState state;
};
RL_STATIC_ASSERT_SIZE(PathVertex, 76);

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

// Shadow rays of a round of shifts, traced by one call: light and path samples, each seen by
// another and seen here. A visibility of 1 stays where none is asked for.
const uint RL_GI_SEGMENTS = 4u;

struct GiSegments {
  Ray rays[RL_GI_SEGMENTS];
  uint asks[RL_GI_SEGMENTS];
  float visibility[RL_GI_SEGMENTS];
};

RL_REF(StoredAnchorRef, StoredAnchor)
RL_REF(StoredAnchorGlossyRef, StoredAnchorGlossy)
RL_REF(ShiftedRef, Shifted)
RL_REF(LightReservoirRef, LightReservoir)
RL_REF(PathVertexRef, PathVertex)
RL_REF(PathSuffixRef, PathSuffix)

struct RestirGiBuffers {
  Vec3Ref radiance;
  Vec3Ref ownLight;  // what is shaded by the pixel's own path: emission, unreusable parts
  StoredAnchorRef anchors;
  StoredAnchorRef previousAnchors;
  StoredAnchorGlossyRef anchorsGlossy;
  StoredAnchorGlossyRef previousAnchorsGlossy;
  LightReservoirRef lights;         // of this frame: initial, then temporal
  LightReservoirRef lightsHistory;  // of the last frame; replaced by the spatial pass
  PathVertexRef paths;
  PathVertexRef pathsHistory;
  PathSuffixRef suffixes;
  PathSuffixRef suffixesHistory;
  // Between the temporal and the spatial pass, spatialNeighbours entries a pixel.
  UintRef partners;          // slots; RL_INVALID: none
  ShiftedRef shiftedLights;  // the pixel's sample as the partner sees it
  ShiftedRef shiftedPaths;
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
