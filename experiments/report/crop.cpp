// Chooses the part of images that a report holds if they are too large for it.
#include <algorithm>
#include <cmath>

#include "experiments/report/pixels.h"

namespace restlab {
namespace {

// Returns min(1, relative error) of each pixel, summed over the images.
std::vector<double> relativeErrors(const std::vector<const Image*>& images,
                                   const Image& reference) {
  std::vector<double> errors(reference.pixels.size(), 0.0);
  for (const Image* image : images) {
    if (image == &reference) continue;
    for (size_t i = 0; i < errors.size(); ++i) {
      const glm::vec3 d = glm::abs(image->pixels[i] - reference.pixels[i]);
      const glm::vec3 r = glm::abs(reference.pixels[i]);
      const double error = double(d.x + d.y + d.z) / (double(r.x + r.y + r.z) + 0.01);
      errors[i] += error < 1.0 ? error : 1.0;  // NaN counts 1
    }
  }
  return errors;
}

// Returns sums[y * (width + 1) + x]: the sum of all values above and left of (x, y).
std::vector<double> prefixSums(const std::vector<double>& values, size_t width, size_t height) {
  std::vector<double> sums((width + 1) * (height + 1), 0.0);
  for (size_t y = 0; y < height; ++y) {
    double row = 0.0;
    for (size_t x = 0; x < width; ++x) {
      row += values[y * width + x];
      sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
    }
  }
  return sums;
}

}  // namespace

Crop chooseCrop(const std::vector<const Image*>& images, const Image* reference, size_t limit) {
  const uint32_t width = images.front()->width, height = images.front()->height;
  const double pixels = double(width) * double(height);
  if (pixels <= double(limit)) return {0, 0, width, height};
  const double scale = std::sqrt(double(limit) / pixels);
  Crop crop;
  crop.width = std::clamp(uint32_t(double(width) * scale), 1u, width);
  crop.height = std::clamp(uint32_t(double(height) * scale), 1u, height);
  // The short side may have been rounded up to one pixel: enforce the limit again.
  crop.width = uint32_t(std::clamp<size_t>(limit / crop.height, 1, crop.width));
  crop.height = uint32_t(std::clamp<size_t>(limit / crop.width, 1, crop.height));
  crop.x = (width - crop.width) / 2;
  crop.y = (height - crop.height) / 2;
  if (!reference || images.size() < 2) return crop;

  const std::vector<double> sums = prefixSums(relativeErrors(images, *reference), width, height);
  const size_t stride = size_t(width) + 1;
  const auto total = [&](uint32_t x, uint32_t y) {
    return sums[(y + crop.height) * stride + x + crop.width] - sums[y * stride + x + crop.width] -
           sums[(y + crop.height) * stride + x] + sums[y * stride + x];
  };
  // Only try positions on a grid, and only move for a clear gain over the centre.
  constexpr uint32_t kGrid = 8;
  double best = 1.001 * total(crop.x, crop.y);
  Crop chosen = crop;
  for (uint32_t y = 0; y + crop.height <= height; y += kGrid) {
    for (uint32_t x = 0; x + crop.width <= width; x += kGrid) {
      if (total(x, y) <= best) continue;
      best = total(x, y);
      chosen.x = x;
      chosen.y = y;
    }
  }
  return chosen;
}

}  // namespace restlab
