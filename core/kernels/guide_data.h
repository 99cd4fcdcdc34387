// What denoisers know of a pixel beside its radiance: its guide, two quads, and its motion, one.
// Distances are kept as disparities, 1 / depth along the camera's axis: of a plane they change
// evenly over the film of a perspective camera, and those of the background are 0.
#ifndef RL_GUIDE_DATA_H
#define RL_GUIDE_DATA_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

const uint RL_GUIDE_QUADS = 2u;

// GuideParams::flags: the radiance is divided by these reflectances before it is filtered.
const uint RL_GUIDE_DIFFUSE = 1u;
const uint RL_GUIDE_SPECULAR = 2u;  // at normal incidence

struct Guide {
  vec3 nW;           // unit, shading; 0 where the background is seen
  float disparity;   // of the surface at the pixel's centre, 1/m
  vec2 slope;        // its change over a pixel to the right, and to the one below
  vec3 reflectance;  // that the radiance is divided by: at least RL_GUIDE_FLOOR, of light in view 1
  uint isLight;      // 1: it shows, in part at least, a light or the background: no filter over
                     // space changes it or asks it
};

// A smaller reflectance would make too much of what is not reflected by it.
const float RL_GUIDE_FLOOR = 0.015625f;

struct Motion {
  vec2 film;        // from here to where the last frame's film showed the surface, in pixels
  float disparity;  // the surface's there, by the last frame's camera, less that of now
  float turn;       // by how much of its lobes' width the view has turned: bsdfTurn()
};

RL_NAMESPACE_END

#endif
