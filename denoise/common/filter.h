// What denoisers that filter over space have in common.
#ifndef RL_FILTER_H
#define RL_FILTER_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/kernels/guide_data.h"

RL_NAMESPACE_BEGIN

// How alike two surfaces must be to share light.
struct FilterEdges {
  float plane;   // distance from each other's plane over the distance to the camera, at which a
                 // weight is 0
  float normal;  // 1 - cosine of normals, at which a weight is 0
};

// What a pixel compares others with.
struct FilterSurface {
  vec3 nW;
  float disparity;
  vec2 slope;
  float perPlane;  // 1 / the distance in disparity at which a weight is 0
  float perNormal;
};

// A pixel between passes.
struct Filtered {
  vec3 light;         // radiance over reflectance
  float reflectance;  // its luminance: light times it is the radiance that a filter keeps in sum;
                      // 0: the pixel has no light that is finite
};

// What decides whether two pixels have the same light: the mean luminance around each, and the
// variance of that mean.
struct Around {
  float luminance;
  float variance;
};

RL_NAMESPACE_END

#endif
