// Buffers and parameters of the voxel cache.
#ifndef RL_VOXEL_CACHE_H
#define RL_VOXEL_CACHE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"

RL_NAMESPACE_BEGIN

struct VoxelCacheBuffers {
  QuadRef visible;    // core/dialect/visible.h
  UintRef proposals;  // entries.proposals a pixel: entries; RL_INVALID: none
  // Of each entry:
  QuadRef anchors;
  UintRef feeders;  // RL_ENTRY_FEEDERS tickets of groups; 0: none
  UintRef keys;     // two words; 0 in the first: nobody's
  UintRef seen;     // frame + 1 in which a pixel last found it
  UintRef claims;   // greatest ticket of the pixels that want the place in this frame; 0: nobody
  // Of each pixel: its entry; RL_INVALID: none; with RL_GRID_CLAIM: the place that it wants.
  UintRef entries;
};

struct VoxelCacheParams {
  EntryParams entries;
  GridParams grid;
  float cellPixels;  // side of a cell, in pixels where it is seen
  SurfaceTest alike;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS VoxelCacheBuffers
#define RL_KERNEL_PARAMS VoxelCacheParams

#endif
