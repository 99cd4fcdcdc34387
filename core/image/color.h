// Colours of linear Rec. 709 images for metrics and previews.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "core/image/image.h"

namespace restlab {

// Relative luminance: BT.709's weights, which papers use with four digits.
inline double luminance(const glm::dvec3& linear) {
  return 0.2126 * linear.x + 0.7152 * linear.y + 0.0722 * linear.z;
}

// sRGB encoding by IEC 61966-2-1, for 0..1.
template <class Real>
Real encodeSrgb(Real linear) {
  if (linear <= Real(0.0031308)) return Real(12.92) * linear;
  return Real(1.055) * std::pow(linear, Real(1) / Real(2.4)) - Real(0.055);
}

// Inverse of encodeSrgb().
template <class Real>
Real decodeSrgb(Real encoded) {
  if (encoded <= Real(12.92 * 0.0031308)) return encoded / Real(12.92);
  return std::pow((encoded + Real(0.055)) / Real(1.055), Real(2.4));
}

// Keeps NaN: both comparisons are false.
inline double clampUnit(double x) { return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x; }

// Counts channel values below `lo` or above `hi`, to report what a clamp changed.
inline size_t countOutside(const Image& image, double lo, double hi) {
  size_t count = 0;
  for (const glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) count += pixel[c] < lo || pixel[c] > hi ? 1u : 0u;
  }
  return count;
}

}  // namespace restlab
