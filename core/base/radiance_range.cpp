#include "core/base/radiance_range.h"

#include <fmt/format.h>

#include <cmath>

#include "core/image/color.h"

namespace restlab {

std::string whyOutsideRange(const DenoiserInfo& denoiser, const Image& radiance) {
  if (!denoiser.comparesSquares) return "";
  double sum = 0.0, lit = 0.0;
  for (const glm::vec3& pixel : radiance.pixels) {
    const double own = luminance(glm::dvec3(pixel));
    if (!(own > 0.0) || std::isinf(own)) continue;
    sum += own;
    lit += 1.0;
  }
  if (lit == 0.0) return "";
  const double mean = sum / lit;
  if (mean >= kLeastFiltered && mean <= kMostFiltered) return "";
  return fmt::format(
      "{}: the mean luminance of what is lit is {:.3g}, and squares of radiance beyond 2^-40 to "
      "2^40 "
      "leave float32's range: the filter weighs otherwise there; scale the light",
      denoiser.name, mean);
}

}  // namespace restlab
