// The mean over the frames that show what a pixel shows at its centre.
#ifndef RL_AVERAGE_H
#define RL_AVERAGE_H

#ifdef __cplusplus
#include "core/dialect/types.h"
#endif
#include "core/dialect/visible.h"

RL_NAMESPACE_BEGIN

// In a buffer it is one quad.
struct Average {
  vec3 mean;
  float frames;  // in it, no more than matter; between pixels no whole number
};

RL_NAMESPACE_END

#endif
