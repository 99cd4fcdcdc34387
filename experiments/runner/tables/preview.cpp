#include "experiments/runner/tables/preview.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace restlab {

namespace {

constexpr uint32_t kBlockSide = 8;

double luminanceOf(const glm::vec3& pixel) {
  return 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
}

bool isFinitePixel(const glm::vec3& pixel) {
  return std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z);
}

size_t blockOf(const Image& image, uint32_t x, uint32_t y) {
  return size_t(y / kBlockSide) * ((image.width + kBlockSide - 1) / kBlockSide) + x / kBlockSide;
}

// Returns the mean luminance of each block's finite pixels, row by row; 0: it has no light.
std::vector<double> blockLuminances(const Image& image) {
  if (image.pixels.empty()) return {};
  std::vector<double> means(blockOf(image, image.width - 1, image.height - 1) + 1, 0.0);
  std::vector<uint32_t> counts(means.size(), 0);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      if (!isFinitePixel(image.at(x, y))) continue;
      means[blockOf(image, x, y)] += luminanceOf(image.at(x, y));
      ++counts[blockOf(image, x, y)];
    }
  }
  for (size_t i = 0; i < means.size(); ++i)
    means[i] = means[i] > 0.0 ? means[i] / double(counts[i]) : 0.0;
  return means;
}

// Returns the largest channel of a pixel; 0 for a black pixel, -1 for one that is not finite.
float brightness(const glm::vec3& pixel) {
  if (!isFinitePixel(pixel)) return -1.0f;
  return luminanceOf(pixel) > 0.0 ? std::max({pixel.x, pixel.y, pixel.z}) : 0.0f;
}

// Returns the value at x, y, or the fourth largest one of the 3x3 around if that is smaller: the
// corner of a lamp has four.
float withoutSpike(const Image& image, const std::vector<float>& values, uint32_t x, uint32_t y) {
  float largest[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  for (uint32_t j = y > 0 ? y - 1 : 0; j <= std::min(image.height - 1, y + 1); ++j) {
    for (uint32_t i = x > 0 ? x - 1 : 0; i <= std::min(image.width - 1, x + 1); ++i) {
      float value = values[size_t(j) * image.width + i];
      for (float& other : largest)
        if (value > other) std::swap(value, other);
    }
  }
  return std::min(values[size_t(y) * image.width + x], largest[3]);
}

template <typename T>
double percentileOf(std::vector<T>& values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return double(*at);
}

}  // namespace

float previewExposure(const Image& image) {
  const std::vector<double> blocks = blockLuminances(image);
  std::vector<double> lit;
  for (const double luminance : blocks)
    if (luminance > 0.0) lit.push_back(luminance);
  if (lit.empty()) return 1.0f;
  // Geometric mean: a lamp in view does not darken the image. Nearly black blocks count as a
  // ten-thousandth of the median.
  const double least = 1e-4 * percentileOf(lit, 0.5);
  double sum = 0.0;
  for (const double luminance : lit) sum += std::log(std::max(luminance, least));
  const double exposure = 0.18 / std::exp(sum / double(lit.size()));
  std::vector<float> values, bright;
  for (const glm::vec3& pixel : image.pixels) values.push_back(brightness(pixel));
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x)
      if (blocks[blockOf(image, x, y)] > 0.0 && values[size_t(y) * image.width + x] >= 0.0f)
        bright.push_back(withoutSpike(image, values, x, y));
  return float(std::clamp(1.0 / percentileOf(bright, 0.99), 0.25 * exposure, exposure));
}

}  // namespace restlab
