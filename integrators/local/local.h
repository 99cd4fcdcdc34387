// Buffers, parameters and state of the `local` kernel.
#ifndef RL_LOCAL_H
#define RL_LOCAL_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/geometry/surface.h"

RL_NAMESPACE_BEGIN

// In the order of the parameters' choices.
const uint RL_LOCAL_CLOSURE = 0u;  // model
const uint RL_LOCAL_LAMBERT = 1u;
const uint RL_LOCAL_PHONG = 2u;
const uint RL_LOCAL_BLINN_PHONG = 3u;
const uint RL_LOCAL_PER_PIXEL = 0u;  // shading
const uint RL_LOCAL_GOURAUD = 1u;
const uint RL_LOCAL_FLAT = 2u;
const uint RL_LOCAL_MIRROR = 1u;  // reflections; 0: none
const uint RL_LOCAL_GLOSSY = 2u;
// Most light samples, and most rays of occlusion, of a vertex.
const uint RL_LOCAL_MOST_RAYS = 64u;

struct LocalBuffers {
  Vec3Ref radiance;
};

struct LocalParams {
  uint model;
  uint shading;
  uint shadows;    // 0: none
  uint occlusion;  // 0: none
  uint reflections;
  uint lightSamples;
  uint occlusionRays;
  float occlusionRadius;  // metres; 0: without end
  float ambient;          // radiance from everywhere
  float highlight;        // of Phong's lobes
  float highlightPower;
};

// One surface that the eye sees, and the points where it is lit.
struct LocalVertex {
  uint events;     // scattering events before it
  uint points;     // 1, or the three corners of a triangle
  uint lights;     // light samples of a point
  uint occlusion;  // rays of occlusion of a point
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS LocalBuffers
#define RL_KERNEL_PARAMS LocalParams

#endif
