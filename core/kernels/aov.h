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
  Vec3Ref object;    // 1 + the scene's number of the instance, as depth
  Vec3Ref emission;  // radiance that the camera sees directly, of lights and of the environment
  Vec3Ref motion;    // to where the last frame showed it: pixels to the right and down; metres from
                     // its camera, 0 where nothing is hit
};

struct AovParams {
  uint padding;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS AovBuffers
#define RL_KERNEL_PARAMS AovParams

#endif
