// Rays per second of Embree alone: the upper bound for a frame's rays per second.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/suite/prepare.h"

namespace restlab {

struct EmbreeRates {
  std::string version;                                   // "4.3.3", of the loaded library
  double primary = 0.0, shadow = 0.0, incoherent = 0.0;  // rays per second
};

struct RaySets {
  std::vector<rl::Ray> primary;     // closest hit, camera rays in 16x16 tiles
  std::vector<rl::Ray> shadow;      // any hit, from the camera rays' hits to points on lights
  std::vector<rl::Ray> incoherent;  // closest hit, cosine-distributed from the same hits
};

// Makes rays from the scene's camera; Embree finds the hits.
RaySets makeRays(const PreparedScene& prepared, uint32_t width, uint32_t height);

// Rays that need no hits: from the camera, and as incoherent ones lines between random points of a
// sphere around the scene.
RaySets makeLines(const PreparedScene& prepared, uint32_t width, uint32_t height);

// Times only queries of core/backend/embree.h, on `threads` threads (0: all). Repeats each kind for
// at least `seconds` and uses the median repetition.
EmbreeRates measureEmbree(const PreparedScene& prepared, const RaySets& rays, int threads,
                          double seconds);

}  // namespace restlab
