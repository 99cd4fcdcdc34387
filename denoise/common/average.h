// Mean over the frames that show the surface at a pixel's centre.
#ifndef RL_AVERAGE_H
#define RL_AVERAGE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/gbuffer/gbuffer.h"

RL_NAMESPACE_BEGIN

// Layout in a buffer: one uvec4.
struct Average {
  vec3 mean;
  float frames;  // number of frames in the mean, capped; no whole number if read between pixels
};

RL_NAMESPACE_END

#endif
