#include "core/image/metrics/pixel_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/nan.h"

namespace restlab {
namespace {

constexpr double kEpsilon = kRelmseEpsilon;  // also the mean1e-2 of the names
constexpr double kTrimFraction = 1e-3;       // the trim0.1 (per cent) of the names

double squared(double x) { return x * x; }

// Calls f(pixel, channel, image's value, reference's value) where the mask selects, in pixel order.
template <class F>
void forEachValue(const Image& image, const Image& reference, const PixelMask& mask, F f) {
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    if (!isSelected(mask, p)) continue;
    for (int c = 0; c < 3; ++c) {
      f(p, c, double(image.pixels[p][c]), double(reference.pixels[p][c]));
    }
  }
}

template <class F>
double meanOver(const Image& image, const Image& reference, const PixelMask& mask, F f) {
  double sum = 0.0;
  size_t count = 0;
  forEachValue(image, reference, mask, [&](size_t, int, double i, double r) {
    sum += f(i, r);
    ++count;
  });
  return sum / double(count);
}

double relativeSquared(double i, double r) { return squared(i - r) / (r * r + kEpsilon); }

double mse(const Image& image, const Image& reference, const PixelMask& mask) {
  return meanOver(image, reference, mask, [](double i, double r) { return squared(i - r); });
}

double meanOfReference(const Image& reference, const PixelMask& mask) {
  return meanOver(reference, reference, mask, [](double, double r) { return r; });
}

MetricValue rmse(const Image& image, const Image& reference, const MetricOptions& options) {
  return {std::sqrt(mse(image, reference, options.mask)), ""};
}

MetricValue trimmedRelativeMse(const Image& image, const Image& reference,
                               const MetricOptions& options) {
  std::vector<double> errors;
  double pixelSum = 0.0;
  forEachValue(image, reference, options.mask, [&](size_t, int c, double i, double r) {
    pixelSum = (c == 0 ? 0.0 : pixelSum) + relativeSquared(i, r);
    if (c == 2) errors.push_back(pixelSum / 3.0);
  });
  return trimmedMean(std::move(errors));
}

// The only convention that leaves pixels out; the detail counts them.
MetricValue relmseSiio(const Image& image, const Image& reference, const MetricOptions& options) {
  size_t zeros = 0, count = 0;
  const auto term = [&](double i, double r) {
    ++count;
    if (r != 0.0) return relativeSquared(i, r);
    ++zeros;
    return 0.0;
  };
  const double value = meanOver(image, reference, options.mask, term);
  return {value, fmt::format("{} of {} channel values have r = 0 and count as 0", zeros, count)};
}

MetricValue relmseMean2(const Image& image, const Image& reference, const MetricOptions& options) {
  const double mean = meanOfReference(reference, options.mask);
  const std::string detail = fmt::format("mean of the reference {:.6g}", mean);
  if (!(mean > 0.0)) return {kNan, detail + ", not positive"};
  const double floor = kEpsilon * mean * mean;
  const auto term = [floor](double i, double r) { return squared(i - r) / (r * r + floor); };
  return {meanOver(image, reference, options.mask, term), detail};
}

MetricValue mapeMean(const Image& image, const Image& reference, const MetricOptions& options) {
  const double mean = meanOfReference(reference, options.mask);
  const std::string detail = fmt::format("mean of the reference {:.6g}", mean);
  if (!(mean > 0.0)) return {kNan, detail + ", not positive"};
  const double floor = kEpsilon * mean;
  const auto term = [floor](double i, double r) { return std::abs(i - r) / (std::abs(r) + floor); };
  return {meanOver(image, reference, options.mask, term), detail};
}

MetricValue psnr(const Image& image, const Image& reference, const MetricOptions& options) {
  double peak = -std::numeric_limits<double>::infinity();
  forEachValue(image, reference, options.mask,
               [&](size_t, int, double, double r) { peak = std::max(peak, r); });
  const std::string detail = fmt::format("peak {:.6g}", peak);
  if (!(peak > 0.0)) return {kNan, detail + ", not positive"};
  return {10.0 * std::log10(peak * peak / mse(image, reference, options.mask)), detail};
}

MetricValue energyRatio(const Image& image, const Image& reference, const MetricOptions& options) {
  const glm::dvec3 a = channelMeans(image, options.mask);
  const glm::dvec3 b = channelMeans(reference, options.mask);
  const glm::dvec3 ratio = a / b;
  return {(a.x + a.y + a.z) / (b.x + b.y + b.z),
          fmt::format("R {:.6g}, G {:.6g}, B {:.6g}", ratio.x, ratio.y, ratio.z)};
}

MetricValue maxError(const Image& image, const Image& reference, const MetricOptions& options) {
  double worst = -1.0;
  size_t worstPixel = 0;
  int worstChannel = 0;
  forEachValue(image, reference, options.mask, [&](size_t p, int c, double i, double r) {
    if (!(std::abs(i - r) > worst)) return;
    worst = std::abs(i - r);
    worstPixel = p;
    worstChannel = c;
  });
  return {worst, fmt::format("at x {} y {} channel {}", worstPixel % image.width,
                             worstPixel / image.width, "RGB"[worstChannel])};
}

MetricValue nonfinite(const Image& image, const Image& reference, const MetricOptions& options) {
  const size_t inside = countNonfinite(image, options.mask);
  std::string detail = fmt::format("{} in the reference", countNonfinite(reference, options.mask));
  if (!options.mask.empty()) {
    detail += fmt::format(", {} of the image outside of the mask", countNonfinite(image) - inside);
  }
  return {double(inside), detail};
}

// A metric that is a mean over pixels and channels.
template <class Term>
MetricInfo meanMetric(const char* name, const char* formula, Term term) {
  return metric(name, formula,
                [term](const Image& image, const Image& reference, const MetricOptions& options) {
                  return MetricValue{meanOver(image, reference, options.mask, term), ""};
                });
}

}  // namespace

MetricValue trimmedMean(std::vector<double> errors) {
  const size_t dropped = size_t(kTrimFraction * double(errors.size()));
  // Sum in ascending order: equal values are interchangeable, so the order is fixed.
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  for (size_t p = 0; p + dropped < errors.size(); ++p) sum += errors[p];
  return {sum / double(errors.size() - dropped),
          fmt::format("dropped {} of {} pixels", dropped, errors.size())};
}

const std::vector<std::string>& relmseConventions() {
  static const std::vector<std::string> names = {"pbrt", "tev", "jeri", "siio", "mean2"};
  return names;
}

std::vector<MetricInfo> pixelMetrics() {
  std::vector<MetricInfo> all;
  all.push_back(meanMetric("mse", "mean d^2", [](double i, double r) { return squared(i - r); }));
  all.push_back(metric("rmse", "sqrt(mean d^2)", rmse));
  all.push_back(meanMetric("mae", "mean |d|", [](double i, double r) { return std::abs(i - r); }));
  all.push_back(meanMetric("relmse_e1e-2", "mean d^2 / (r^2 + 1e-2)", relativeSquared));
  all.push_back(
      metric("relmse_e1e-2_trim0.1",
             "relmse_e1e-2 per pixel, mean without the largest 0.1 % (rounded down) of pixels",
             trimmedRelativeMse));
  all.push_back(meanMetric("relmse_pbrt", "mean d^2 / (r + 1e-2)^2", [](double i, double r) {
    return squared(i - r) / squared(r + kEpsilon);
  }));
  all.push_back(meanMetric("relmse_tev", "mean d^2 / (r^2 + 1e-2)", relativeSquared));
  all.push_back(meanMetric("relmse_jeri", "mean d^2 / (r^2 + 1e-4)",
                           [](double i, double r) { return squared(i - r) / (r * r + 1e-4); }));
  all.push_back(metric("relmse_siio",
                       "mean d^2 / (r^2 + 1e-2), of which 0 counts where r = 0; how often is said",
                       relmseSiio));
  all.push_back(metric("relmse_mean2", "mean d^2 / (r^2 + 1e-2 mean(r)^2)", relmseMean2));
  all.push_back(meanMetric("mape_e1e-2", "mean |d| / (|r| + 1e-2)", [](double i, double r) {
    return std::abs(i - r) / (std::abs(r) + kEpsilon);
  }));
  all.push_back(metric("mape_mean1e-2", "mean |d| / (|r| + 1e-2 mean(r))", mapeMean));
  all.push_back(
      meanMetric("smape", "mean |d| / ((|image| + |r|) / 2 + 1e-2)", [](double i, double r) {
        return std::abs(i - r) / (0.5 * (std::abs(i) + std::abs(r)) + kEpsilon);
      }));
  all.push_back(
      metric("psnr", "10 log10(peak^2 / mse) in dB, peak = largest reference value", psnr));
  all.back().higherIsBetter = true;
  all.push_back(metric("energy_ratio", "mean(image) / mean(reference), ideal 1", energyRatio));
  all.push_back(
      metric("nonfinite", "count of NaN and infinite channel values of the image", nonfinite));
  all.push_back(metric("max_err", "max |d|, with its pixel and channel", maxError));
  return all;
}

}  // namespace restlab
