// Visible surface at the centre of a pixel: the key by which histories follow surfaces. Independent
// of film samples: an acceptance test that depended on the sample it accepts would be biased.
#ifndef RL_GBUFFER_H
#define RL_GBUFFER_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct GBufferTexel {
  vec3 posW;      // if nothing is hit: unit view direction
  uint isHit;     // 0: the background
  uint emits;     // 1: emits towards the camera
  uint isMirror;  // 1: shows sharp images of lamps (bsdfIsMirror, RL_MIRROR_ALPHA)
  uint nGeoW;     // packNormal(); unit, on the side of the camera
  uint nShadeW;
  vec3 reflectance;  // bsdfReflectance(), 0 to 1
};

// Thresholds at which two surfaces are similar enough to share samples.
struct SimilarityThresholds {
  float minNormalDot;
  float maxPlaneDistance;  // relative to the distance to the camera
};

// Layout in a buffer, one uvec4: the distance along the ray through the pixel's centre with
// isMirror as its sign, two normals, and the reflectance with emits and isHit.

// GGX alpha below which a mirror shows sharp images of lamps: a roughness of 0.2.
const float RL_MIRROR_ALPHA = 0.04f;

RL_NAMESPACE_END

#endif
