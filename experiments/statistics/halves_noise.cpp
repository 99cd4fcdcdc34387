#include "experiments/statistics/halves_noise.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace restlab {

namespace {

void requireSize(const Image& image, const Image& half) {
  if (image.width == half.width && image.height == half.height) return;
  failInput(fmt::format("a half of the reference is {}x{}, what is compared with it {}x{}",
                        half.width, half.height, image.width, image.height));
}

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// x d of a pixel (experiments/statistics/halves_noise.h).
double alongDifference(glm::vec3 run, glm::vec3 half0, glm::vec3 half1) {
  const glm::dvec3 a(half0), b(half1);
  return dot(glm::dvec3(run) - 0.5 * (a + b), a - b);
}

}  // namespace

HalvesNoise halvesNoise(const Image& half0, const Image& half1, const PixelMask& mask) {
  requireSize(half0, half1);
  const double channels = 3.0 * double(countSelected(mask, half0.pixels.size()));
  HalvesNoise noise;
  for (size_t p = 0; p < half0.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    const glm::dvec3 difference = glm::dvec3(half0.pixels[p]) - glm::dvec3(half1.pixels[p]);
    const double squared = dot(difference, difference);
    noise.varianceOfHalf += squared / (2.0 * channels);
    noise.varianceOfProduct += squared * squared / (12.0 * channels * channels);
  }
  return noise;
}

double sharedVariance(const std::vector<Image>& runs, const Image& half0, const Image& half1,
                      const PixelMask& mask) {
  for (const Image& run : runs) requireSize(run, half0);
  requireSize(half0, half1);
  const double channels = 3.0 * double(countSelected(mask, half0.pixels.size()));
  const double n = double(runs.size());
  double ofPairs = 0.0;
  for (size_t p = 0; p < half0.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    double sum = 0.0, squares = 0.0;
    for (const Image& run : runs) {
      const double along = alongDifference(run.pixels[p], half0.pixels[p], half1.pixels[p]);
      sum += along;
      squares += along * along;
    }
    ofPairs += sum * sum - squares;
  }
  return ofPairs / (n * (n - 1.0) * channels * channels);
}

double sharedVarianceAtMost(const Image& run, const Image& half0, const Image& half1,
                            const PixelMask& mask) {
  requireSize(run, half0);
  requireSize(half0, half1);
  const double channels = 3.0 * double(countSelected(mask, half0.pixels.size()));
  double sum = 0.0;
  for (size_t p = 0; p < half0.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    const double along = alongDifference(run.pixels[p], half0.pixels[p], half1.pixels[p]);
    sum += along * along;
  }
  return sum / (channels * channels);
}

}  // namespace restlab
