#include "experiments/runner/tables/preview.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace restlab {

double previewLuminance(const glm::vec3& pixel) {
  const double luminance = 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
  return luminance > 0.0 && !std::isinf(luminance) ? luminance : 0.0;
}

float previewExposure(const Image& reference) {
  std::vector<double> luminances;
  std::vector<float> brightest;
  for (const glm::vec3& pixel : reference.pixels) {
    const double luminance = previewLuminance(pixel);
    // Black pixels do not brighten the image, such as those around a room in an empty scene.
    if (luminance == 0.0) continue;
    luminances.push_back(luminance);
    brightest.push_back(std::max({pixel.x, pixel.y, pixel.z}));
  }
  return previewExposure(std::move(luminances), std::move(brightest));
}

float previewExposure(std::vector<double> luminances, std::vector<float> brightest) {
  if (brightest.empty() || luminances.empty()) return 1.0f;
  const auto percentileOf = [](auto& values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
  };
  // Geometric mean: a lamp in view does not darken the image. Nearly black pixels count as a
  // ten-thousandth of the median.
  const double least = 1e-4 * percentileOf(luminances, 0.5);
  double sum = 0.0;
  for (const double luminance : luminances) sum += std::log(std::max(luminance, least));
  const double exposure = 0.18 / std::exp(sum / double(luminances.size()));
  // Clips at most one lit pixel in a hundred, but darkens by at most two stops for that.
  return float(std::clamp(1.0 / percentileOf(brightest, 0.99), 0.25 * exposure, exposure));
}

}  // namespace restlab
