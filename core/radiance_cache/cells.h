// Buffers and parameters of the passes that fill cells of radiance.
#ifndef RL_RADIANCE_CELLS_H
#define RL_RADIANCE_CELLS_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/radiance_cache/radiance.h"
#include "core/transport/light_sum.h"

RL_NAMESPACE_BEGIN

// Buffer names match those in the passes of core/caches/entries.
struct RadianceCellBuffers {
  RadianceBuffers cells;
  // Per group, RL_RADIANCE_POINT_UVEC4S: hit of the group's ray of the last frame.
  Uvec4Ref points;
  // Per cell, RL_RADIANCE_KEPT_UVEC4S: a path that fed the cell, to be traced again.
  Uvec4Ref kept;
  UintRef seen;        // per cell: frame + 1 in which a point last belonged to the cell
  UintRef claims;      // per cell: greatest priority that claims the hash slot
  UintRef insertions;  // per cell: RL_ENTRY_INSERTIONS priorities of groups; 0: none
  UintRef entries;  // per group: its cell, RL_INVALID, or RL_GRID_CLAIM with the claimed hash slot
};

struct RadianceCellParams {
  EntryParams entries;
  GridParams grid;
  RadianceParams cells;
  uint validateEvery;  // one of so many cells has its path traced again in a frame
};

// State of a path from a point on: gathers all light that leaves the point, without its emission.
struct RadianceTrace {
  LightSum sum;
  vec3 posW;
  vec3 nGeoW;
  vec3 reflectance;
  float posError;  // metres
  uint hasPoint;
};

// Layout of a point: position and normal (packNormal); light that left the point over its
// reflectance, and posError, negative if there is no point.
const uint RL_RADIANCE_POINT_UVEC4S = 2u;
// Layout of a kept path: the ray as in RadianceBuffers::rays, with the frame in its last word; the
// light that the path found over the reflectance, and the group.
const uint RL_RADIANCE_KEPT_UVEC4S = 3u;
// A cell's path is traced again if the cell was seen within this many frames.
const uint RL_RADIANCE_RECENT = 64u;
// Largest difference of two results of one path over their sum at which they count as equal.
const float RL_RADIANCE_SAME = 1.0e-3f;

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RadianceCellBuffers
#define RL_KERNEL_PARAMS RadianceCellParams

#endif
