#include "core/image/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace restlab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kEpsilon = 1e-2;       // the e1e-2 of the names
constexpr double kTrimFraction = 1e-3;  // the trim0.1 (per cent) of the names

void requireSameSize(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height) {
    failInput(fmt::format("image is {}x{} but the reference is {}x{}: metrics need equal sizes",
                          image.width, image.height, reference.width, reference.height));
  }
  if (image.pixels.empty()) failInput("image has no pixels: metrics need at least one");
}

// Mean of f(i, r) over pixels and channels, in pixel order.
template <class F>
double meanOver(const Image& image, const Image& reference, F f) {
  double sum = 0.0;
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      sum += f(double(image.pixels[p][c]), double(reference.pixels[p][c]));
    }
  }
  return sum / (3.0 * double(image.pixels.size()));
}

double squared(double x) { return x * x; }

double relativeSquared(double i, double r) { return squared(i - r) / (r * r + kEpsilon); }

double mse(const Image& image, const Image& reference) {
  return meanOver(image, reference, [](double i, double r) { return squared(i - r); });
}

MetricValue trimmedRelativeMse(const Image& image, const Image& reference) {
  std::vector<double> errors(image.pixels.size());
  for (size_t p = 0; p < errors.size(); ++p) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += relativeSquared(image.pixels[p][c], reference.pixels[p][c]);
    errors[p] = sum / 3.0;
  }
  const size_t dropped = size_t(kTrimFraction * double(errors.size()));
  // Summed in ascending order: equal values are interchangeable, so the order is fixed.
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  for (size_t p = 0; p + dropped < errors.size(); ++p) sum += errors[p];
  return {sum / double(errors.size() - dropped),
          fmt::format("dropped {} of {} pixels", dropped, errors.size())};
}

MetricValue psnr(const Image& image, const Image& reference) {
  double peak = -std::numeric_limits<double>::infinity();
  for (const glm::vec3& r : reference.pixels) {
    for (int c = 0; c < 3; ++c) peak = std::max(peak, double(r[c]));
  }
  const std::string detail = fmt::format("peak {:.6g}", peak);
  if (!(peak > 0.0)) return {kNan, detail + ", not positive"};
  return {10.0 * std::log10(peak * peak / mse(image, reference)), detail};
}

MetricValue energyRatio(const Image& image, const Image& reference) {
  const glm::dvec3 a = channelMeans(image);
  const glm::dvec3 b = channelMeans(reference);
  const glm::dvec3 ratio = a / b;
  return {(a.x + a.y + a.z) / (b.x + b.y + b.z),
          fmt::format("R {:.6g}, G {:.6g}, B {:.6g}", ratio.x, ratio.y, ratio.z)};
}

MetricValue maxError(const Image& image, const Image& reference) {
  double worst = -1.0;
  size_t worstPixel = 0;
  int worstChannel = 0;
  for (size_t p = 0; p < image.pixels.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      const double error = std::abs(double(image.pixels[p][c]) - double(reference.pixels[p][c]));
      if (error > worst) {
        worst = error;
        worstPixel = p;
        worstChannel = c;
      }
    }
  }
  return {worst, fmt::format("at x {} y {} channel {}", worstPixel % image.width,
                             worstPixel / image.width, "RGB"[worstChannel])};
}

MetricValue nonfinite(const Image& image, const Image& reference) {
  return {double(countNonfinite(image)),
          fmt::format("{} in the reference", countNonfinite(reference))};
}

// A metric that is a mean over pixels and channels.
template <class F>
MetricInfo meanMetric(const char* name, const char* formula, F f) {
  return {name, formula, false, [f](const Image& image, const Image& reference) {
            return MetricValue{meanOver(image, reference, f), ""};
          }};
}

std::vector<MetricInfo> makeRegistry() {
  std::vector<MetricInfo> all;
  all.push_back(meanMetric("mse", "mean d^2", [](double i, double r) { return squared(i - r); }));
  all.push_back({"rmse", "sqrt(mean d^2)", false, [](const Image& image, const Image& reference) {
                   return MetricValue{std::sqrt(mse(image, reference)), ""};
                 }});
  all.push_back(meanMetric("mae", "mean |d|", [](double i, double r) { return std::abs(i - r); }));
  all.push_back(meanMetric("relmse_e1e-2", "mean d^2 / (r^2 + 1e-2)", relativeSquared));
  all.push_back({"relmse_e1e-2_trim0.1",
                 "relmse_e1e-2 per pixel, mean without the largest 0.1 % (rounded down) of pixels",
                 false, trimmedRelativeMse});
  all.push_back(meanMetric("mape_e1e-2", "mean |d| / (|r| + 1e-2)", [](double i, double r) {
    return std::abs(i - r) / (std::abs(r) + kEpsilon);
  }));
  all.push_back(
      meanMetric("smape", "mean |d| / ((|image| + |r|) / 2 + 1e-2)", [](double i, double r) {
        return std::abs(i - r) / (0.5 * (std::abs(i) + std::abs(r)) + kEpsilon);
      }));
  all.push_back(
      {"psnr", "10 log10(peak^2 / mse) in dB, peak = largest reference value", true, psnr});
  all.push_back({"energy_ratio", "mean(image) / mean(reference), ideal 1", false, energyRatio});
  all.push_back({"max_err", "max |d|, with its pixel and channel", false, maxError});
  all.push_back(
      {"nonfinite", "count of NaN and infinite channel values of the image", false, nonfinite});
  return all;
}

// A NaN in either image must reach the result whatever a metric's arithmetic does with it
// (comparisons drop NaN, and an infinite denominator would hide an infinite error).
MetricValue guarded(const MetricInfo& metric, const Image& image, const Image& reference) {
  requireSameSize(image, reference);
  if (metric.name != "nonfinite") {
    const size_t inImage = countNonfinite(image);
    const size_t inReference = countNonfinite(reference);
    if (inImage + inReference > 0) {
      return {kNan, fmt::format("{} non-finite values in the image, {} in the reference", inImage,
                                inReference)};
    }
  }
  return metric.function(image, reference);
}

std::vector<MetricInfo> makeGuardedRegistry() {
  std::vector<MetricInfo> all = makeRegistry();
  for (MetricInfo& metric : all) {
    metric.function = [raw = metric](const Image& image, const Image& reference) {
      return guarded(raw, image, reference);
    };
  }
  return all;
}

}  // namespace

const std::vector<MetricInfo>& metricRegistry() {
  static const std::vector<MetricInfo> registry = makeGuardedRegistry();
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

MetricValue evaluateMetric(const std::string& name, const Image& image, const Image& reference) {
  return findMetric(name).function(image, reference);
}

size_t countNonfinite(const Image& image) {
  size_t count = 0;
  for (const glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) count += std::isfinite(pixel[c]) ? 0u : 1u;
  }
  return count;
}

glm::dvec3 channelMeans(const Image& image) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& pixel : image.pixels) sum += glm::dvec3(pixel);
  return sum / double(image.pixels.size());
}

glm::dvec3 energyRatioPerChannel(const Image& image, const Image& reference) {
  requireSameSize(image, reference);
  return channelMeans(image) / channelMeans(reference);
}

}  // namespace restlab
