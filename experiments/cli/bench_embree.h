// Rays per second through Embree alone: the roof that a frame's rays per second are held against.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/run/prepare.h"

namespace restlab {

struct EmbreeRates {
  std::string version;                                   // "4.3.3", of the library that ran
  double primary = 0.0, shadow = 0.0, incoherent = 0.0;  // rays per second
};

struct RaySets {
  std::vector<rl::Ray> primary;     // closest hit, camera rays in 16x16 tiles
  std::vector<rl::Ray> shadow;      // any hit, from the camera rays' hits to points on lights
  std::vector<rl::Ray> incoherent;  // closest hit, cosine-distributed from the same hits
};

// Of the camera of the scene; hits are found by Embree.
RaySets makeRays(const PreparedScene& prepared, uint32_t width, uint32_t height);

// Only queries of core/backend/embree.h are timed, on `threads` threads
// (0: all). Each kind is repeated for at least `seconds`; the median repetition counts.
EmbreeRates measureEmbree(const PreparedScene& prepared, const RaySets& rays, int threads,
                          double seconds);

}  // namespace restlab
