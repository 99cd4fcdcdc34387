// State of a path sample's shift to another pixel.
#ifndef RL_PATH_SHIFT_H
#define RL_PATH_SHIFT_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/path_sample/path_sample.h"

RL_NAMESPACE_BEGIN

// The ray that a shift asks for next.
const uint RL_SHIFT_DONE = 0u;
const uint RL_SHIFT_NEEDS_X1 = 1u;       // camera ray through the film sample
const uint RL_SHIFT_NEEDS_SEGMENT = 2u;  // from x1 to x2 or the light

struct PathShift {
  Shifted shifted;  // result, once the shift asks for nothing
  Ray ray;
  uint needs;           // RL_SHIFT_*
  uint assumesVisible;  // 1: the segment is not traced
  uint rank;            // of the body that the segment lies in
};

RL_NAMESPACE_END

#endif
