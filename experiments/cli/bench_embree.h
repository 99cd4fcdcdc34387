// Rays per second through Embree alone: the roof that a frame's rays per second are held against.
#pragma once

#include <cstddef>

#include "experiments/runner/prepare.h"

namespace restlab {

struct EmbreeRates {
  double primary = 0.0;     // closest hit, camera rays in 16x16 tiles; rays per second
  double shadow = 0.0;      // any hit, from the camera rays' hits to points on lights
  double incoherent = 0.0;  // closest hit, cosine-distributed directions from the same hits
  size_t hits = 0;          // camera rays that hit something
};

// Rays are made beforehand; only rtcIntersect1 and rtcOccluded1 are timed, on `threads` threads
// (0: all). Each kind is repeated for at least `seconds`; the median repetition counts.
EmbreeRates measureEmbree(const PreparedScene& prepared, uint32_t width, uint32_t height,
                          int threads, double seconds);

}  // namespace restlab
