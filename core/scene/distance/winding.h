// How often a closed surface winds around the samples of a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/distance/triangles.h"

namespace restlab {

// Places of samples: low + cell i.
struct SamplePlaces {
  glm::ivec3 samples{0};
  glm::dvec3 low{0.0};
  double cell = 0.0;

  double at(int axis, int i) const { return low[axis] + cell * double(i); }
};

// One for each sample, x fastest: 1 where the winding number is not 0.
std::vector<uint8_t> insideSamples(const ClosedTriangles& surface, const SamplePlaces& places);

}  // namespace restlab
