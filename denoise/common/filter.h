// Types of denoisers that filter over space.
#ifndef RL_FILTER_H
#define RL_FILTER_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/gbuffer/guide_data.h"

RL_NAMESPACE_BEGIN

// Thresholds at which two surfaces are similar enough to share light.
struct FilterEdges {
  float plane;   // distance from each other's plane over the distance to the camera, at which a
                 // weight is 0
  float normal;  // 1 - cosine of normals, at which a weight is 0
};

// Surface of the pixel that is filtered, to compare others with.
struct FilterSurface {
  vec3 nW;
  float disparity;
  vec2 slope;
  float perPlane;  // 1 / the distance in disparity at which a weight is 0
  float perNormal;
};

// Value of a pixel between passes.
struct Filtered {
  vec3 light;         // radiance over reflectance
  float reflectance;  // luminance of the reflectance (filters conserve the sum of light times
                      // this); 0: the pixel has no finite light
};

// Mean luminance around a pixel and the variance of that mean, which decide whether two pixels have
// the same light.
struct LocalLuminance {
  float luminance;
  float variance;
};

RL_NAMESPACE_END

#endif
