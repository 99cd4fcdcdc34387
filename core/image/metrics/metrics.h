// Image metrics whose names fix their formulas. d = image - reference, r = reference, both in
// linear Rec. 709; "mean" runs over all pixels that count and the three channels.
//
// Sums are doubles taken in pixel order, so a value is the same for any thread count. A NaN or an
// infinity in a pixel that counts, of either image, makes every metric but `nonfinite` NaN; the
// detail says how many. Nothing else is left out, unless the formula says so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/image/metrics/flip.h"
#include "core/image/metrics/mask.h"

namespace restlab {

struct MetricValue {
  double value = 0.0;
  std::string detail;  // further facts: the pixel, the peak, the dropped pixels; or ""
};

struct MetricOptions {
  PixelMask mask;  // the pixels that count
  FlipOptions flip;
};

struct MetricInfo {
  std::string name;
  std::string formula;          // one line for lists and reports
  bool higherIsBetter = false;  // energy_ratio: neither, its ideal is 1 (the formula says so)
  // Computed on the whole image, from which a mask then picks pixels: a non-finite value counts
  // wherever it is.
  bool readsNeighbours = false;
  // Needs several images (experiments/statistics/bias_runs.h); NaN for a single one.
  bool needsRuns = false;
  std::function<MetricValue(const Image& image, const Image& reference,
                            const MetricOptions& options)>
      function;
};

template <class Function>
MetricInfo metric(const char* name, const char* formula, Function function) {
  MetricInfo info;
  info.name = name;
  info.formula = formula;
  info.function = function;
  return info;
}

// All metrics, in the order of reports.
const std::vector<MetricInfo>& metricRegistry();
std::vector<std::string> metricNames();

// Throws Error (badUsage) with the nearest name if the metric is unknown.
const MetricInfo& findMetric(const std::string& name);

// Throws Error: badUsage for an unknown name or options out of range, badInput for empty images,
// different sizes or a mask of another size or of no pixel.
MetricValue evaluateMetric(const std::string& name, const Image& image, const Image& reference,
                           const MetricOptions& options = {});

// NaN and infinite channel values in an image.
size_t countNonfinite(const Image& image, const PixelMask& mask = {});

// Mean of each channel.
glm::dvec3 channelMeans(const Image& image, const PixelMask& mask = {});

// mean(image) / mean(reference), channel by channel. Throws Error (badInput) on different sizes.
glm::dvec3 energyRatioPerChannel(const Image& image, const Image& reference);

// mean (image - half0)(image - half1): the mean squared error of one image against the truth, with
// no share of the reference's own error, where half0 and half1 are independent, unbiased halves of
// the reference. May be negative when the error is below the reference's noise.
// Throws Error (badInput) on different sizes or a mask that selects nothing.
double mseAgainstHalves(const Image& image, const Image& half0, const Image& half1,
                        const PixelMask& mask = {});

// mean (runs0 - half0)(runs1 - half1): squared bias of a method, where runs0 and runs1 are the
// means of two disjoint sets of independent runs. Unbiased and signed: about 0, of either sign, for
// an unbiased method.
double squaredBias(const Image& runs0, const Image& runs1, const Image& half0, const Image& half1,
                   const PixelMask& mask = {});

// mean (image - half0)(image - half1) / (divisor^2 + 1e-2): relmse_e1e-2 with no share of the
// reference's own error in its numerators, and without the 0.1 % of the pixels with the largest
// error. `divisor` is the mean of the reference; one of its halves shows the influence of its
// noise. Throws Error (badInput) on different sizes or a mask that selects nothing.
struct RelativeError {
  double relmse = 0.0, trimmed = 0.0;  // NaN if a value that counts is not finite
  std::string detail;                  // detail of `trimmed`
};
RelativeError relmseAgainstHalves(const Image& image, const Image& divisor, const Image& half0,
                                  const Image& half1, const PixelMask& mask = {});

// One value per pixel, averaged over channels, whose mean is `mse` or `mseAgainstHalves`.
std::vector<double> squaredErrorPerPixel(const Image& image, const Image& reference);
std::vector<double> squaredErrorPerPixel(const Image& image, const Image& half0,
                                         const Image& half1);

// Share of the sum in the largest `fraction` of the pixels (rounded up to whole pixels): how much
// of an MSE is a few fireflies. 0 when the sum is 0, NaN when it is negative or NaN.
double worstPixelShare(const std::vector<double>& errorPerPixel, double fraction = 1e-3);

}  // namespace restlab
