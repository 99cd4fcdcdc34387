// Buffers and parameters of the surflet cache.
#ifndef RL_SURFLET_CACHE_H
#define RL_SURFLET_CACHE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"

RL_NAMESPACE_BEGIN

struct SurfletCacheBuffers {
  Uvec4Ref gbuffer;   // core/gbuffer/gbuffer.h
  UintRef proposals;  // entries.proposals entries per pixel; RL_INVALID: none
  // Per entry:
  Uvec4Ref shadingPoints;
  UintRef insertions;  // RL_ENTRY_INSERTIONS priorities of groups; 0: none
  UintRef keys;        // two words; 0 in the first: empty
  UintRef seen;        // frame + 1 in which a pixel last found the entry
  UintRef claims;      // greatest priority that claims the hash slot in this frame; 0: none
  // Per pixel: its entry; RL_INVALID: none; with RL_GRID_CLAIM: the hash slot that it claims.
  UintRef entries;
  Uvec4Ref discs;  // per entry, as shading points: centre, normals; radius in place of posError
};

struct SurfletCacheParams {
  EntryParams entries;
  GridParams grid;
  float discPixels;  // radius of a disc, in pixels where it is spawned
  SimilarityThresholds similarity;
};

RL_NAMESPACE_END

#define RL_KERNEL_BUFFERS SurfletCacheBuffers
#define RL_KERNEL_PARAMS SurfletCacheParams

#endif
