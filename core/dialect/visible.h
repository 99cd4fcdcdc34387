// What the centre of a pixel shows: the key by which histories follow surfaces. It knows no film
// sample: a test that looked at the sample which it lets through would bias what it lets through.
#ifndef RL_VISIBLE_H
#define RL_VISIBLE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct VisibleSurface {
  vec3 posW;   // where nothing is hit: the direction of the view, unit
  uint isHit;  // 0: the background
  uint emits;  // 1: a surface that shines at the camera
  uint nGeoW;  // packNormal(); unit, on the side of the camera
  uint nShadeW;
  vec3 reflectance;  // bsdfReflectance(), 0 to 1
};

// When two of them are alike enough to share samples.
struct SurfaceTest {
  float minNormalDot;
  float maxPlaneDistance;  // over the distance to the camera
};

// In a buffer it is one quad: the distance along the ray through the pixel's centre, two normals,
// the reflectance, emits, isHit.

RL_NAMESPACE_END

#endif
