// State of the prefix of a path that is traced again for another pixel.
#ifndef RL_PATH_REPLAY_H
#define RL_PATH_REPLAY_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/path_sample/path_sample.h"
#include "core/transport/walk.h"

RL_NAMESPACE_BEGIN

// The vertex before, as the test of connection needs it.
struct PathConnector {
  vec3 posW;        // of the vertex before
  uint isRough;     // 1: that vertex is rough
  float footprint;  // m^2, of x1: what a pixel's ray stands for there
};

struct PathReplay {
  PathConnector before;
  uint base;        // PathSample::base
  uint kind;        // RL_PATH_*
  uint isMirrored;  // 1: all vertices so far are mirrors
  uint failed;      // RL_FAILED_NOT: what follows is set
  Surface x;        // the vertex after `base` events
  vec3 throughput;  // f |cos| / pdf up to it, without Russian roulette
  vec3 sigma;       // m^-1, of the medium that the segment from it lies in
  uint rank;        // of the body that the segment lies in
  vec3 radiance;    // RL_PATH_WHOLE_REPLAY: the light found, with its MIS weight
};

RL_NAMESPACE_END

#endif
