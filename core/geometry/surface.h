// A shading point.
#ifndef RL_SURFACE_H
#define RL_SURFACE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#include "core/shading/bsdf.h"
#endif

RL_NAMESPACE_BEGIN

// Names a point of a surface, whatever becomes of its triangle.
struct SurfaceId {
  uint instance;  // RL_INVALID: none
  uint primitive;
  vec2 bary;
};

// The point that an id names, without its material.
struct SurfacePoint {
  vec3 posW;
  float posError;  // metres, as Surface::posError
  vec3 normalW;    // unit, geometric: of the triangle's front
};

struct Surface {
  SurfaceId id;
  uint isFront;  // 1: wo is on the front of the triangle
  vec3 posW;
  float posError;  // metres: bound of the rounding error of posW and of a test against its triangle
  vec3 nGeoW;      // unit, on the side of wo
  vec3 nShadeW;    // unit, dot(nShadeW, nGeoW) > 0
  vec3 wo;         // unit, towards where the ray came from
  vec3 emission;   // radiance towards wo
  vec3 sigmaBeyond;  // m^-1, extinction beyond the surface, for rays that cross it; set by the walk
  float contrast;    // index of refraction inside over outside where the outside is not air; else 0
  uint light;        // index in the light table, RL_INVALID where it does not emit
  Bsdf bsdf;
};

// The interface between two media at a hit (core/transport/media.glsl).
struct MediaCrossing {
  uvec4 behind;     // bodies that contain the point behind the hit
  float contrast;   // index of refraction inside over outside; 0: as the material says
  uint isSurface;   // 0: the same body goes on, and the ray passes
  uint isTouching;  // 1: surfaces of several bodies lie here, within twice the position error
};

// A triangle in world space: a corner and the edges to the other two.
struct TriangleW {
  vec3 p0;
  vec3 e1;
  vec3 e2;
  float magnitude;  // largest coordinate in the computation of the triangle
};

RL_NAMESPACE_END

#endif
