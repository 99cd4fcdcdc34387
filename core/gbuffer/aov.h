// Buffers of the `aov` kernel: first-hit attributes for AOVs and denoisers.
#ifndef RL_AOV_H
#define RL_AOV_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif

RL_NAMESPACE_BEGIN

struct AovBuffers {
  Vec3Ref positionW;
  Vec3Ref normalW;
  Vec3Ref albedo;
  Vec3Ref depth;     // metres along the ray, the same in all three channels; 0 where nothing is hit
  Vec3Ref object;    // 1 + number of the scene's instance, in all channels; 0 where nothing is hit
  Vec3Ref emission;  // radiance that the camera sees directly, of lights and of the environment
  Vec3Ref motion;    // vector to the point's place in the last frame: pixels to the right and down;
                     // metres from the last camera, 0 where nothing is hit
  Vec3Ref ambient;   // ambient light that the surface sends on, in the radiance already
};

struct AovParams {
  uint padding;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS AovBuffers
#define RL_KERNEL_PARAMS AovParams

#endif
