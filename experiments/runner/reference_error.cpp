#include "experiments/runner/reference_error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace restlab {

namespace {

bool identical(const Image& a, const Image& b) {
  return std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

}  // namespace

MetricValue errorAgainst(const std::string& metric, const Image& image, const Reference& reference,
                         const MetricOptions& options) {
  // The halves are for images that are independent of the reference, which it itself is not.
  if (metric != "mse" || !reference.half0 || identical(image, reference.mean)) {
    return evaluateMetric(metric, image, reference.mean, options);
  }
  const double value = mseAgainstHalves(image, *reference.half0, *reference.half1, options.mask);
  if (!std::isnan(value)) return {value, "against the reference's two halves"};
  return {value, fmt::format("{} non-finite values in the image, {} in the reference's halves",
                             countNonfinite(image, options.mask),
                             countNonfinite(*reference.half0, options.mask) +
                                 countNonfinite(*reference.half1, options.mask))};
}

double sharedNoiseOfMse(const Reference& reference) {
  if (!reference.half0 || !reference.half1) return 0.0;
  const std::vector<glm::vec3>&half0 = reference.half0->pixels, &half1 = reference.half1->pixels;
  double sum = 0.0;
  for (size_t i = 0; i < half0.size(); ++i) {
    // d^2 / 2 estimates the variance of a half, and its square three times that variance's.
    const glm::dvec3 d = glm::dvec3(half0[i]) - glm::dvec3(half1[i]);
    const double variance = glm::dot(d, d) / 6.0;
    sum += variance * variance / 3.0;
  }
  return std::sqrt(sum) / double(half0.size());
}

}  // namespace restlab
