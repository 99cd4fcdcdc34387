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

}  // namespace restlab
