// Parameters of the hashed grid (core/caches/entries/grid.glsl).
#ifndef RL_GRID_H
#define RL_GRID_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

// In the kernels' gParams.grid.
struct GridParams {
  uint places;  // for entries
  uint probes;  // of them where an entry may lie
};

const uint RL_GRID_TAKEN = 0x80000000u;  // in the first word of every key
const uint RL_GRID_CLAIM = 0x80000000u;  // a place that a pixel wants, not an entry that it has

// Floors and walls lie at round numbers and face along the axes: there rounding would decide which
// cell a point is in. So the grid begins beside zero (in sides of a cell), octants do, too.
const float RL_GRID_OFF = 0.381966f;
const float RL_GRID_OFF_NORMAL = 0.0137f;

RL_NAMESPACE_END

#endif
