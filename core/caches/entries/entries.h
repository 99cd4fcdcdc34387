// Caches in world space keep entries, each with a reservoir for one surface point, its
// shading point. Types shared by caches and integrators (core/caches/README.md).
#ifndef RL_ENTRIES_H
#define RL_ENTRIES_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/resampling/reservoir.h"

RL_NAMESPACE_BEGIN

// A surface point that a reservoir is valid at.
struct ShadingPoint {
  GBufferTexel surface;  // isHit is 0: there is no shading point
  float posError;        // metres: bound of the rounding error of its position
  uint sourcePixel;      // index of the pixel whose film sample led here; it may not use the entry
};

const uint RL_SHADING_POINT_UVEC4S = 2u;
// Most samples that an entry takes per frame.
const uint RL_ENTRY_INSERTIONS = 4u;

// In the kernels' gParams.entries.
struct EntryParams {
  uint count;        // number of entries; 0: the cache has none
  uint proposals;    // entries a pixel takes as donors; at most RL_MAX_DONORS
  uint insertEvery;  // one of so many adjacent pixels inserts its sample
  float cap;         // cap of an entry's confidence, in samples
  float spread;      // distance of further donors, in sides of a cell or radii of a disc
};

RL_NAMESPACE_END

#endif
