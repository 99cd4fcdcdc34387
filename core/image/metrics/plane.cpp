#include "core/image/metrics/plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace restlab {
namespace {

constexpr size_t kRowsPerBand = 64;

}  // namespace

Kernel gaussian(double sigma, size_t radius) {
  Kernel kernel(2 * radius + 1);
  for (size_t i = 0; i < kernel.size(); ++i) {
    const double x = double(i) - double(radius);
    kernel[i] = std::exp(-x * x / (2.0 * sigma * sigma));
  }
  return kernel;
}

Kernel normalised(Kernel kernel) {
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

Plane filtered(const Plane& plane, const Kernel& across, const Kernel& down) {
  Plane rows(plane.width - (across.size() - 1), plane.height);
  for (size_t y = 0; y < rows.height; ++y) {
    const double* from = plane.values.data() + y * plane.width;
    double* to = rows.values.data() + y * rows.width;
    for (size_t k = 0; k < across.size(); ++k) {
      for (size_t x = 0; x < rows.width; ++x) to[x] += across[k] * from[x + k];
    }
  }
  Plane result(rows.width, rows.height - (down.size() - 1));
  for (size_t y = 0; y < result.height; ++y) {
    double* to = result.values.data() + y * result.width;
    for (size_t k = 0; k < down.size(); ++k) {
      const double* from = rows.values.data() + (y + k) * rows.width;
      for (size_t x = 0; x < result.width; ++x) to[x] += down[k] * from[x];
    }
  }
  return result;
}

std::vector<glm::dvec3> bandOfPixels(const Image& image, size_t firstRow, size_t rows,
                                     size_t border) {
  std::vector<glm::dvec3> band;
  band.reserve((image.width + 2 * border) * (rows + 2 * border));
  const auto inside = [border](size_t at, size_t size) {  // `at` counts from -border
    return at < border ? 0 : std::min(at - border, size - 1);
  };
  for (size_t y = 0; y < rows + 2 * border; ++y) {
    const size_t row = inside(firstRow + y, image.height) * image.width;
    for (size_t x = 0; x < image.width + 2 * border; ++x) {
      band.emplace_back(image.pixels[row + inside(x, image.width)]);
    }
  }
  return band;
}

void forEachBand(size_t height, const std::function<void(size_t firstRow, size_t rows)>& work) {
  const size_t bands = (height + kRowsPerBand - 1) / kRowsPerBand;
  tbb::parallel_for(size_t(0), bands, [&](size_t band) {
    const size_t first = band * kRowsPerBand;
    work(first, std::min(kRowsPerBand, height - first));
  });
}

}  // namespace restlab
