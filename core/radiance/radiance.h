// Cells of radiance: what integrators read and write of them (core/radiance/README.md).
#ifndef RL_RADIANCE_H
#define RL_RADIANCE_H

#ifdef __cplusplus
#include "core/dialect/order.h"
#endif
#include "core/caches/entries/entries.h"
#include "core/caches/entries/grid.h"

RL_NAMESPACE_BEGIN

struct RadianceBuffers {
  UintRef keys;    // of cells: core/caches/entries/grid.glsl
  QuadRef places;  // of cells: a point over the surface that began it, and its normal (packNormal)
  QuadRef light;   // of cells: mean of radiance over reflectance, and of how many samples
  QuadRef rays;    // RL_RADIANCE_RAY_QUADS of each group: what integrators ask to be traced
};

// In the kernels' gParams.cells.
struct RadianceParams {
  uint count;  // of cells; 0: paths do not end in any
  GridParams grid;
  uint every;        // one of so many pixels side by side asks for a ray
  float cellPixels;  // side of a cell, in pixels where it is seen
  float footprint;   // of a path, in sides of a cell, from which on it may end
  float minAlpha;    // GGX alpha below which a surface has no cells
  float leastCount;  // samples of a cell before a path may end there
};

// Of a path under way.
struct RadianceEnd {
  float spread;  // metres: how far apart the points lie that it could as well have led to
  uint group;    // that may ask for a ray; RL_INVALID: none, or it has asked
};

// A ray of a group is its origin and direction: in the fourth words the number of scattering events
// before it, 0 where there is no ray, and nothing.
const uint RL_RADIANCE_RAY_QUADS = 2u;

// Least cosine between normals, of a point and the cell that it belongs to.
const float RL_RADIANCE_MIN_DOT = 0.9f;

RL_NAMESPACE_END

#endif
