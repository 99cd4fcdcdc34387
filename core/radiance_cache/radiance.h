// Radiance cells: buffers and parameters that integrators use (core/radiance_cache/README.md).
#ifndef RL_RADIANCE_H
#define RL_RADIANCE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"

RL_NAMESPACE_BEGIN

struct RadianceBuffers {
  UintRef keys;     // per cell: core/caches/entries/grid.glsl
  Uvec4Ref places;  // per cell: viewpoint over the point that began it; normal there (packNormal)
  Uvec4Ref light;   // per cell: mean of radiance over reflectance, and its number of samples
  Uvec4Ref rays;    // per group, RL_RADIANCE_RAY_UVEC4S: ray that an integrator asks for
};

// In the kernels' gParams.cells.
struct RadianceParams {
  uint count;  // number of cells; 0: paths do not end in cells
  GridParams grid;
  uint every;        // one of so many adjacent pixels asks for a ray
  float cellPixels;  // side of a cell, in pixels where it is seen
  float footprint;   // spread of a path, in sides of a cell, from which on it may end
  float minAlpha;    // GGX alpha below which a surface has no cells
  float leastCount;  // samples of a cell before a path may end there
};

// State of a path that may end in a cell.
struct CacheTermination {
  float spread;  // metres: width of the area that the path could equally have led to
  uint group;    // group whose ray the path may ask for; RL_INVALID: none, or already asked
};

// Layout of a ray: origin and direction. Fourth words: the number of scattering events before the
// ray (0: no ray), and unused.
const uint RL_RADIANCE_RAY_UVEC4S = 2u;

// Least cosine between the normals of a point and of the cell that the point belongs to.
const float RL_RADIANCE_MIN_DOT = 0.9f;

RL_NAMESPACE_END

#endif
