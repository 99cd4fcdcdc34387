// A virtual gonioreflectometer: the BRDF of a rough surface, by rays through its heights.
#pragma once

#include <cstdint>

#include "core/image/image.h"
#include "core/scene/closure_table/closure_table.h"

namespace restlab {

// The material of the facets.
enum class FacetBase { lambert, mirror };

struct HeightField {
  // Heights at the corners of square cells, in the red channel; the surface repeats itself.
  Image heights;
  double spacing = 1.0;  // of two corners, in the unit of the heights
};

struct SimulationConfig {
  FacetBase base = FacetBase::lambert;
  double albedo = 1.0;              // of the facets
  uint32_t bounces = 8;             // scattering events after which a ray is absorbed
  uint64_t samples = 1'000'000;     // rays for each theta of wo
  glm::uvec3 sizes{32u, 32u, 32u};  // of a table of directions
  uint64_t seed = 1;
};

struct Simulation {
  ClosureTable table;     // of directions, reciprocal
  double absorbed = 0.0;  // share of rays that were not out after `bounces`
  uint64_t lostRays = 0;  // fell through a seam of the triangles: nothing of them is counted
  double slope = 0.0;     // root of the mean of dz/dx^2 + dz/dy^2: alpha of Beckmann's facets
};

// Traces from random places towards random azimuths. Throws Error (badInput) for a field of fewer
// than 2 x 2 heights, or with values that are not finite.
Simulation simulateBrdf(const HeightField& field, const SimulationConfig& config);

}  // namespace restlab
