// The rasteriser of the CPU backend: scanlines over tiles, with edge functions.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "core/dialect/types.h"
#include "core/raster/raster.h"

namespace restlab {

struct RasterScene {
  std::span<const rl::Geometry> geometries;
  std::span<const rl::Instance> instances;
};

struct RasterTarget {
  glm::uvec2 size;  // pixels
  glm::uvec4* hits;
  glm::vec4* diffuse;    // null: corners have no light
  glm::vec4* highlight;  // likewise
};

struct RasterStages {
  // Runs the vertex stage over corners, on all threads: writes raster.corners.
  std::function<void(const rl::RasterBuffers& raster, uint32_t corners)> vertices;
  // Runs the fragment stage over at most RL_ENTRY_ROW fragments, in the calling thread.
  std::function<void(const rl::RasterBuffers& raster, uint32_t fragments)> fragments;
  // Calls `run` for 0 to count - 1, on all threads.
  std::function<void(size_t count, const std::function<void(size_t)>& run)> parallel;
};

// Draws all triangles of a scene in the order of its instances, and keeps the nearest one at each
// pixel's point; of several at one distance the first. Coverage is decided by homogeneous edge
// functions in double precision (Olano and Greer 1997): no triangle has to be cut at the plane of
// the camera, and a point on an edge belongs to one of its two triangles. Weights are correct in
// perspective. The result does not depend on the number of threads.
void rasterise(const RasterScene& scene, const RasterTarget& target, const rl::RasterParams& params,
               const RasterStages& stages);

}  // namespace restlab
