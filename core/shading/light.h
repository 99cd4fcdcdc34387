// A point on a light, or a direction to the environment, as drawn by light sampling or found by a
// ray.
#ifndef RL_LIGHT_H
#define RL_LIGHT_H

#ifdef __cplusplus
#include "core/dialect/dialect.h"
#include "core/geometry/surface.h"
#endif

RL_NAMESPACE_BEGIN

// How a receiver chooses among the parts of a node in the hierarchy of lamps.
struct LightTurn {
  uvec3 bounds;  // of 32 random bits: those below x take part 0, below y part 1, below z part 2
  uint last;     // the part that all others take; RL_INVALID: no part can send light
};

// Where light arrives.
struct LightReceiver {
  vec3 posW;
  uint isTwoSided;  // 1: light from behind the surface counts, too
  vec3 normalW;     // unit
};

struct LightSample {
  vec3 point;   // world position; a unit direction to the light where kind is directional or
                // environment
  uint kind;    // RL_LIGHT_*
  vec3 normal;  // triangle: unit normal of the emitting side; spot: direction of travel; point:
                // attenuation 1 / (x + y r + z r^2)
  float
      pdf;  // selection included: per area (triangle), per solid angle (environment), discrete else
  vec3 radiance;   // W sr^-1 m^-2; W/sr for points (spot falloff depends on the receiver's
                   // direction); W/m^2 for directional lights
  float posError;  // metres; triangles only
  vec2 cone;       // spot: scale and offset of the angular falloff
  uint isTwoSided;
  uint record;   // index in the light table; RL_INVALID if a ray found the light
  SurfaceId id;  // triangles only
};

// A light sample as a receiver sees it.
struct LightConnection {
  vec3 dirW;       // unit, receiver to light
  float distance;  // metres; 0 means at infinity
  vec3 emitted;  // radiance for area lights and the environment; irradiance factor for delta lights
  float geometry;  // |cos_light| / d^2 for triangles, 1 otherwise (d^2 of points is in `emitted`)
  float pdfSolidAngle;  // by light sampling; 0 for delta lights, which BSDF sampling cannot find
  bool isDelta;
};

RL_NAMESPACE_END

#endif
