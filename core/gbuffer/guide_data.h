// Features of a pixel for denoisers, beside its radiance: its guide, two uvec4s, and its motion,
// one uvec4. Distances are kept as disparities, 1 / depth along the camera's axis: on a plane,
// disparities are linear over the film of a perspective camera, and the background's are 0.
#ifndef RL_GUIDE_DATA_H
#define RL_GUIDE_DATA_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_GUIDE_UVEC4S = 2u;

// GuideParams::flags: the radiance is divided by these reflectances before it is filtered.
const uint RL_GUIDE_DIFFUSE = 1u;
const uint RL_GUIDE_SPECULAR = 2u;  // at normal incidence
const uint RL_GUIDE_RASTER = 4u;    // the rasteriser has found what the pixels show

struct Guide {
  vec3 nW;           // unit, shading; 0 where the background is seen
  float disparity;   // surface at the pixel's centre, 1/m
  vec2 slope;        // change of disparity per pixel to the right, and per pixel down
  vec3 reflectance;  // divisor of the radiance: at least RL_GUIDE_FLOOR; 1 for light in view
  uint isLight;  // 1: the pixel shows, at least in part, a light or the background: spatial filters
                 // neither change nor read it
};

// A smaller divisor would amplify light that is not reflected by this reflectance.
const float RL_GUIDE_FLOOR = 0.015625f;

struct Motion {
  vec2 film;        // from here to where the last frame's film showed the surface, in pixels
  float disparity;  // disparity by the last frame's camera minus the one by this frame's
  float turn;       // turn of the view over the width of the surface's lobes: bsdfLobeRotation()
};

RL_NAMESPACE_END

#endif
