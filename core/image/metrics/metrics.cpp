// The registry of metrics, and their common checks: sizes, masks, bad values.
#include "core/image/metrics/metrics.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/image/metrics/pixel_metrics.h"
#include "core/image/metrics/window_metrics.h"

namespace restlab {
namespace {

void requireSameSize(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height) {
    failInput(fmt::format("image is {}x{} but the reference is {}x{}: metrics need equal sizes",
                          image.width, image.height, reference.width, reference.height));
  }
  if (image.pixels.empty()) failInput("image has no pixels: metrics need at least one");
}

MetricInfo biasRmsInfo() {
  MetricInfo info;
  info.name = "bias_rms";
  info.formula =
      "sqrt(max(0, b)), b = mean over pixels and over all pairs i != j of independent runs of "
      "(run_i - half0)(run_j - half1), half0 and half1 those of the reference; b is said, signed";
  info.needsRuns = true;
  info.function = [](const Image&, const Image&, const MetricOptions&) {
    return MetricValue{kNan, "needs several independent runs"};
  };
  return info;
}

// Makes a NaN in either image reach the result whatever a metric's arithmetic does with it
// (comparisons drop NaN, an infinite denominator would hide an infinite error, and a display clips
// infinity to white).
MetricValue guarded(const MetricInfo& metric, const Image& image, const Image& reference,
                    const MetricOptions& options) {
  requireSameSize(image, reference);
  countSelected(options.mask, image.pixels.size());
  if (metric.name != "nonfinite") {
    const PixelMask everywhere;
    const PixelMask& read = metric.readsNeighbours ? everywhere : options.mask;
    const size_t inImage = countNonfinite(image, read);
    const size_t inReference = countNonfinite(reference, read);
    if (inImage + inReference > 0) {
      return {kNan, fmt::format("{} non-finite values in the image, {} in the reference", inImage,
                                inReference)};
    }
  }
  return metric.function(image, reference, options);
}

std::vector<MetricInfo> makeRegistry() {
  std::vector<MetricInfo> all = pixelMetrics();
  for (MetricInfo& metric : windowMetrics()) all.push_back(std::move(metric));
  all.push_back(biasRmsInfo());
  for (MetricInfo& metric : all) {
    metric.function = [raw = metric](const Image& image, const Image& reference,
                                     const MetricOptions& options) {
      return guarded(raw, image, reference, options);
    };
  }
  return all;
}

}  // namespace

const std::vector<MetricInfo>& metricRegistry() {
  static const std::vector<MetricInfo> registry = makeRegistry();
  return registry;
}

std::vector<std::string> metricNames() {
  std::vector<std::string> names;
  for (const MetricInfo& metric : metricRegistry()) names.push_back(metric.name);
  return names;
}

const MetricInfo& findMetric(const std::string& name) {
  for (const MetricInfo& metric : metricRegistry()) {
    if (metric.name == name) return metric;
  }
  failUsage(fmt::format("unknown metric '{}'{}", name, didYouMean(name, metricNames())));
}

MetricValue evaluateMetric(const std::string& name, const Image& image, const Image& reference,
                           const MetricOptions& options) {
  return findMetric(name).function(image, reference, options);
}

size_t countNonfinite(const Image& image, const PixelMask& mask) {
  size_t count = 0;
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    for (int c = 0; c < 3; ++c) count += std::isfinite(image.pixels[p][c]) ? 0u : 1u;
  }
  return count;
}

glm::dvec3 channelMeans(const Image& image, const PixelMask& mask) {
  glm::dvec3 sum(0.0);
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    if (isSelected(mask, p)) sum += glm::dvec3(image.pixels[p]);
  }
  return sum / double(countSelected(mask, image.pixels.size()));
}

glm::dvec3 energyRatioPerChannel(const Image& image, const Image& reference) {
  requireSameSize(image, reference);
  return channelMeans(image) / channelMeans(reference);
}

}  // namespace restlab
