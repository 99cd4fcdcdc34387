#include "core/image/metrics/window_metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/image/color.h"
#include "core/image/metrics/flip.h"
#include "core/image/metrics/ssim.h"

namespace restlab {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double meanOfMap(const std::vector<double>& map, const PixelMask& mask) {
  double sum = 0.0;
  for (size_t p = 0; p < map.size(); ++p) {
    if (isSelected(mask, p)) sum += map[p];
  }
  return sum / double(countSelected(mask, map.size()));
}

// Says how many channel values a clip to lo..hi changes.
std::string clipText(const Image& image, const Image& reference, double lo, double hi) {
  return fmt::format("{} channel values of the image and {} of the reference",
                     countOutside(image, lo, hi), countOutside(reference, lo, hi));
}

MetricValue ssim(const Image& image, const Image& reference, const MetricOptions& options) {
  return {meanOfMap(ssimPerPixel(image, reference), options.mask),
          "clipped to 0..1: " + clipText(image, reference, 0.0, 1.0)};
}

std::string viewText(const FlipOptions& flip) {
  return fmt::format("{:.6g} pixels per degree", flip.pixelsPerDegree);
}

MetricValue flipLdr(const Image& image, const Image& reference, const MetricOptions& options) {
  requireFlipOptions(options.flip);
  const std::vector<double> map = flipLdrPerPixel(image, reference, options.flip.pixelsPerDegree);
  return {meanOfMap(map, options.mask),
          fmt::format("{}, no tone mapping; clipped to 0..1: {}", viewText(options.flip),
                      clipText(image, reference, 0.0, 1.0))};
}

MetricValue flipHdr(const Image& image, const Image& reference, const MetricOptions& options) {
  requireFlipOptions(options.flip);
  FlipExposureChoice choice{options.flip.exposures, "given"};
  if (!choice.exposures) {
    choice = chooseFlipExposures(reference);
    if (!choice.exposures) return {std::nan(""), choice.note};
    choice.note = "from the reference" + (choice.note.empty() ? "" : ": " + choice.note);
  }
  const FlipExposures& exposures = *choice.exposures;
  const std::vector<double> map =
      flipHdrPerPixel(image, reference, exposures, options.flip.pixelsPerDegree);
  return {meanOfMap(map, options.mask),
          fmt::format("{}, ACES tone mapping (Narkowicz), {} exposures 2^{:.6f} to 2^{:.6f} ({}); "
                      "negative and taken as 0: {}",
                      viewText(options.flip), exposures.count, exposures.start, exposures.stop,
                      choice.note, clipText(image, reference, 0.0, kInfinity))};
}

template <class Function>
MetricInfo windowMetric(const char* name, const char* formula, Function function) {
  MetricInfo info = metric(name, formula, function);
  info.readsNeighbours = true;
  return info;
}

}  // namespace

std::vector<MetricInfo> windowMetrics() {
  std::vector<MetricInfo> all;
  all.push_back(windowMetric("ssim",
                             "mean SSIM (Wang et al. 2004) of R, G, B clipped to 0..1 and sRGB "
                             "encoded; 11x11 pixels, sigma 1.5, K1 0.01, K2 0.03",
                             ssim));
  all.back().higherIsBetter = true;
  all.push_back(windowMetric(
      "flip_ldr", "mean FLIP (Andersson et al. 2020) of values clipped to 0..1; takes seconds",
      flipLdr));
  all.push_back(windowMetric("flip_hdr",
                             "mean FLIP over exposures, per pixel the largest (Andersson et al. "
                             "2021), ACES tone mapping; takes seconds",
                             flipHdr));
  return all;
}

}  // namespace restlab
