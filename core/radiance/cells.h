// Buffers and parameters of the passes that fill cells of radiance.
#ifndef RL_RADIANCE_CELLS_H
#define RL_RADIANCE_CELLS_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/radiance/radiance.h"
#include "core/transport/light_sum.h"

RL_NAMESPACE_BEGIN

// The names are those that the passes of entries use (core/caches/entries).
struct RadianceCellBuffers {
  RadianceBuffers cells;
  // RL_RADIANCE_POINT_QUADS of each group: where its ray of the last frame led to.
  QuadRef points;
  // RL_RADIANCE_KEPT_QUADS of each cell: a path that fed it, to be traced again.
  QuadRef kept;
  UintRef seen;     // of cells: frame + 1 in which a point last belonged to it
  UintRef claims;   // of cells: greatest ticket of those who want the place
  UintRef feeders;  // of cells: RL_ENTRY_FEEDERS tickets of groups; 0: none
  UintRef entries;  // of groups: as a pixel's
};

struct RadianceCellParams {
  EntryParams entries;
  GridParams grid;
  RadianceParams cells;
  uint validateEvery;  // one of so many cells has its path traced again in a frame
};

// A path from a point on: all light that leaves the point but what it emits.
struct RadianceTrace {
  LightSum sum;
  vec3 posW;
  vec3 nGeoW;
  vec3 reflectance;
  float posError;  // metres
  uint hasPoint;
};

// Position and normal (packNormal); what left it over its reflectance, and posError, negative where
// there is no point.
const uint RL_RADIANCE_POINT_QUADS = 2u;
// The ray as in RadianceBuffers::rays, with the frame in its last word; what the path found over
// the reflectance, and the group.
const uint RL_RADIANCE_KEPT_QUADS = 3u;
// Frames within which a cell was seen whose path is traced again.
const uint RL_RADIANCE_RECENT = 64u;
// Largest difference of two results of one path over their sum.
const float RL_RADIANCE_SAME = 1.0e-3f;

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS RadianceCellBuffers
#define RL_KERNEL_PARAMS RadianceCellParams

#endif
