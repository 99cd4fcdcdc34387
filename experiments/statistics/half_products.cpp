// Squared errors against a reference in two independent halves: the reference's own variance, which
// an ordinary MSE would add, cancels in the product of two independent deviations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/image/metrics/metrics.h"
#include "core/image/metrics/pixel_metrics.h"

namespace restlab {
namespace {

void requireSize(const Image& image, const Image& other, const char* what) {
  if (image.width != other.width || image.height != other.height) {
    failInput(fmt::format("image is {}x{} but the {} is {}x{}: metrics need equal sizes",
                          image.width, image.height, what, other.width, other.height));
  }
  if (image.pixels.empty()) failInput("image has no pixels: metrics need at least one");
}

// (a - b)(c - d) of one pixel, averaged over channels.
double product(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  const glm::dvec3 left = glm::dvec3(a) - glm::dvec3(b);
  const glm::dvec3 right = glm::dvec3(c) - glm::dvec3(d);
  return (left.x * right.x + left.y * right.y + left.z * right.z) / 3.0;
}

}  // namespace

double squaredBias(const Image& runs0, const Image& runs1, const Image& half0, const Image& half1,
                   const PixelMask& mask) {
  requireSize(runs0, runs1, "second set of runs");
  requireSize(runs0, half0, "reference's first half");
  requireSize(runs0, half1, "reference's second half");
  const size_t count = countSelected(mask, runs0.pixels.size());
  double sum = 0.0;
  for (size_t p = 0; p < runs0.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    sum += product(runs0.pixels[p], half0.pixels[p], runs1.pixels[p], half1.pixels[p]);
  }
  // An infinite pixel must not pass as a merely large error; inf * 0 is NaN already.
  return std::isfinite(sum) ? sum / double(count) : kNan;
}

double mseAgainstHalves(const Image& image, const Image& half0, const Image& half1,
                        const PixelMask& mask) {
  return squaredBias(image, image, half0, half1, mask);
}

RelativeError relmseAgainstHalves(const Image& image, const Image& divisor, const Image& half0,
                                  const Image& half1, const PixelMask& mask) {
  requireSize(image, divisor, "reference");
  requireSize(image, half0, "reference's first half");
  requireSize(image, half1, "reference's second half");
  std::vector<double> errors;
  errors.reserve(countSelected(mask, image.pixels.size()));
  double sum = 0.0;
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    const glm::dvec3 i(image.pixels[p]), a(half0.pixels[p]), b(half1.pixels[p]),
        r(divisor.pixels[p]);
    const glm::dvec3 relative = (i - a) * (i - b) / (r * r + kRelmseEpsilon);
    errors.push_back((relative.x + relative.y + relative.z) / 3.0);
    sum += errors.back();
  }
  if (!std::isfinite(sum)) return {kNan, kNan, ""};
  const double relmse = sum / double(errors.size());
  const MetricValue trimmed = trimmedMean(std::move(errors));
  return {relmse, trimmed.value, trimmed.detail};
}

std::vector<double> squaredErrorPerPixel(const Image& image, const Image& reference) {
  return squaredErrorPerPixel(image, reference, reference);
}

std::vector<double> squaredErrorPerPixel(const Image& image, const Image& half0,
                                         const Image& half1) {
  requireSize(image, half0, "reference");
  requireSize(image, half1, "reference's second half");
  std::vector<double> errors(image.pixels.size());
  for (size_t p = 0; p < errors.size(); ++p) {
    errors[p] = product(image.pixels[p], half0.pixels[p], image.pixels[p], half1.pixels[p]);
  }
  return errors;
}

double worstPixelShare(const std::vector<double>& errorPerPixel, double fraction) {
  double total = 0.0;
  for (const double error : errorPerPixel) total += error;
  if (total == 0.0) return 0.0;
  if (!(total > 0.0) || !std::isfinite(total)) return kNan;
  std::vector<double> sorted = errorPerPixel;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const size_t count = std::min(sorted.size(), size_t(std::ceil(fraction * double(sorted.size()))));
  double worst = 0.0;
  for (size_t p = 0; p < count; ++p) worst += sorted[p];
  return worst / total;
}

}  // namespace restlab
