// Parameters of the hashed grid (core/caches/entries/grid.glsl).
#ifndef RL_GRID_H
#define RL_GRID_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif

RL_NAMESPACE_BEGIN

// In the kernels' gParams.grid.
struct GridParams {
  uint places;  // hash slots for entries
  uint probes;  // hash slots in which an entry may lie
};

const uint RL_GRID_TAKEN = 0x80000000u;  // set in the first word of every key
const uint RL_GRID_CLAIM = 0x80000000u;  // marks a claimed hash slot instead of an owned entry

// Offsets of the grid (in sides of a cell) and of octants from zero. Floors and walls lie at round
// numbers and face along the axes: without offsets, rounding would decide which cell a point is in.
const float RL_GRID_OFF = 0.381966f;
const float RL_GRID_OFF_NORMAL = 0.0137f;

RL_NAMESPACE_END

#endif
