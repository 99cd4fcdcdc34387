// One number per pixel in double precision, and separable filters, for metrics that look at the
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

// Divides a kernel by its sum.
Kernel normalised(Kernel kernel);

// Correlates `plane` with across(x) down(y) wherever both kernels lie inside it: the result is
// smaller by their sizes minus one.
Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down);

// Copies rows firstRow..firstRow+rows of an image with `border` pixels around them; beyond the
// image, edge pixels repeat.
std::vector<glm::dvec3> bandOfPixels(const Image& image, size_t firstRow, size_t rows,
                                     size_t border);

// Calls work(firstRow, rows) for bands that cover `height`, on all processors: outputs of bands
// must not overlap. Bounds the memory of filters to a few bands.
void forEachBand(size_t height, const std::function<void(size_t firstRow, size_t rows)>& work);

}  // namespace restlab
