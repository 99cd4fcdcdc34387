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

// Why a shift has no result.
const uint RL_FAILED_NOT = 0u;
const uint RL_FAILED_EMPTY = 1u;       // the reservoir holds no sample
const uint RL_FAILED_ABSORBED = 2u;    // the camera is inside a body that absorbs
const uint RL_FAILED_BACKGROUND = 3u;  // the film sample shows no surface
const uint RL_FAILED_SMOOTH = 4u;      // x1 is smooth
const uint RL_FAILED_REPLAY = 5u;      // the replay came to no vertex of the kind that the path has
const uint RL_FAILED_CONNECTS = 6u;    // an earlier pair of vertices connects: there is no inverse
const uint RL_FAILED_PAIR = 7u;        // the pair that reconnects is not connectable here
const uint RL_FAILED_ENTRY = 8u;       // entries hold no path of this kind
const uint RL_FAILED_JACOBIAN = 9u;    // outside [1 / max_jacobian, max_jacobian]
const uint RL_FAILED_DARK = 10u;       // nothing is sent this way, or reflected
const uint RL_FAILED_OCCLUDED = 11u;   // the segment to x2 or to the light is blocked

struct PathShift {
  Shifted shifted;  // result, once the shift asks for nothing
  Ray ray;
  uint needs;           // RL_SHIFT_*
  uint assumesVisible;  // 1: the segment is not traced
  uint rank;            // of the body that the segment lies in
  uint failed;          // RL_FAILED_*
};

RL_NAMESPACE_END

#endif
