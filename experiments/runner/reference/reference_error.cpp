#include "experiments/runner/reference/reference_error.h"

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
  // The two-halves estimate needs an image that is independent of the reference: not the reference.
  const bool isRelative = metric == "relmse_e1e-2" || metric == "relmse_e1e-2_trim0.1";
  if (!(metric == "mse" || isRelative) || !reference.half0 || identical(image, reference.mean)) {
    return evaluateMetric(metric, image, reference.mean, options);
  }
  const Image &half0 = *reference.half0, &half1 = *reference.half1;
  MetricValue error;
  if (isRelative) {
    const RelativeError both =
        relmseAgainstHalves(image, reference.mean, half0, half1, options.mask);
    error.value = metric == "relmse_e1e-2" ? both.relmse : both.trimmed;
    error.detail = "against the reference's two halves";
    if (metric != "relmse_e1e-2") error.detail += ", " + both.detail;
  } else {
    error = {mseAgainstHalves(image, half0, half1, options.mask),
             "against the reference's two halves"};
  }
  if (!std::isnan(error.value)) return error;
  return {error.value,
          fmt::format("{} non-finite values in the image, {} in the reference's halves",
                      countNonfinite(image, options.mask),
                      countNonfinite(half0, options.mask) + countNonfinite(half1, options.mask))};
}

}  // namespace restlab
