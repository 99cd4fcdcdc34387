// One number a pixel in double precision, and separable filters, for metrics that look at the
// neighbourhood of a pixel.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/image/image.h"

namespace restlab {

struct Plane {
  size_t width = 0, height = 0;
  std::vector<double> values;

  Plane() = default;
  Plane(size_t w, size_t h) : width(w), height(h), values(w * h) {}
};

// Weights at -radius..radius.
using Kernel = std::vector<double>;

// exp(-x^2 / (2 sigma^2)), not normalised.
Kernel gaussian(double sigma, size_t radius);

// Divided by its sum.
Kernel normalised(Kernel kernel);

// Correlation with across(x) down(y) at the places where both lie inside `plane`: the result is
// smaller by their sizes less one.
Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down);

// Rows firstRow..firstRow+rows of an image, and `border` pixels around them, which beyond the edges
// repeat the edge's.
std::vector<glm::dvec3> bandOfPixels(const Image& image, size_t firstRow, size_t rows,
                                     size_t border);

// Calls work(firstRow, rows) for bands that make up `height`, on all processors: what they write
// must not overlap. Bounds the memory of filters to a few bands.
void forEachBand(size_t height, const std::function<void(size_t firstRow, size_t rows)>& work);

}  // namespace restlab
