// Viewing of images by FLIP: the exposures of its HDR variant, and the checks of its options.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/color.h"
#include "core/image/metrics/flip.h"
#include "core/image/metrics/flip_color.h"

namespace restlab {
namespace {

// Position on the tone-mapped scale above which contrast is lost.
constexpr double kBrightestShown = 0.85;

// Median; of an even number of values, the upper middle one.
double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void requireFlipOptions(const FlipOptions& options) {
  const double density = options.pixelsPerDegree;
  if (!(density >= kFlipMinPixelsPerDegree && density <= kFlipMaxPixelsPerDegree)) {
    failUsage(fmt::format("FLIP: {} pixels per degree must be in {}..{}", density,
                          kFlipMinPixelsPerDegree, kFlipMaxPixelsPerDegree));
  }
  if (!options.exposures) return;
  const FlipExposures& e = *options.exposures;
  if (!(e.start >= -kFlipMaxExposure && e.start <= e.stop && e.stop <= kFlipMaxExposure)) {
    failUsage(fmt::format("FLIP: exposures {} to {} must be in -{}..{}, the lower one first",
                          e.start, e.stop, kFlipMaxExposure, kFlipMaxExposure));
  }
  if (e.count < 1 || e.count > kFlipMaxExposures) {
    failUsage(fmt::format("FLIP: {} exposures must be 1 to {}", e.count, kFlipMaxExposures));
  }
}

FlipExposureChoice chooseFlipExposures(const Image& reference) {
  std::vector<double> all, lit;
  for (const glm::vec3& pixel : reference.pixels) {
    const double y = luminance(glm::dvec3(pixel));
    if (!std::isfinite(y)) return {std::nullopt, "the reference is not finite"};
    all.push_back(y);
    if (y > 0.0) lit.push_back(y);
  }
  if (lit.empty()) return {std::nullopt, "the reference has no light: give the exposures"};
  FlipExposureChoice choice;
  double typical = median(all);
  if (!(typical > 0.0)) {
    typical = median(lit);
    choice.note = fmt::format("median of the {} of {} pixels with light, the others being black",
                              lit.size(), all.size());
  }
  const double radiance = flip::radianceShownAs(kBrightestShown);
  FlipExposures exposures;
  exposures.start = std::log2(radiance / *std::max_element(lit.begin(), lit.end()));
  exposures.stop = std::log2(radiance / typical);
  const double stops = std::ceil(exposures.stop - exposures.start);
  if (stops > kFlipMaxExposures) {
    return {std::nullopt, fmt::format("the reference spans {} stops, more than {}: give the "
                                      "exposures",
                                      stops, kFlipMaxExposures)};
  }
  exposures.count = uint32_t(std::max(2.0, stops));
  choice.exposures = exposures;
  return choice;
}

}  // namespace restlab
