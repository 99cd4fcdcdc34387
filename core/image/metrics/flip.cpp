#include "core/image/metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/image/color.h"
#include "core/image/metrics/flip_color.h"
#include "core/image/metrics/plane.h"

namespace restlab {
namespace {

// Constants of the colour pipeline.
constexpr double kColorExponent = 0.7;
constexpr double kKneeOfError = 0.4;    // fraction of the largest colour error ...
constexpr double kKneeOfResult = 0.95;  // ... and the result there
// Constants of the feature pipeline: width of the detected features in degrees, exponent.
constexpr double kFeatureWidth = 0.082;
constexpr double kFeatureExponent = 0.5;

// Contrast sensitivity, in space: sums of scale sqrt(pi / variance) exp(-pi^2 x^2 / variance), x in
// degrees. The achromatic and the red-green channel have one term, blue-yellow has two.
struct Sensitivity {
  double scale, variance;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestVariance = 0.04;

double sigmaInPixels(double variance, double pixelsPerDegree) {
  return std::sqrt(variance / 2.0) / std::numbers::pi * pixelsPerDegree;
}

// Filters of one common radius, so that their results for a band have equal size; narrower filters
// are 0 at the ends.
struct Filters {
  size_t radius = 0;
  Kernel achromatic, redGreen, blueYellow[2];
  double blueYellowShare[2] = {};
  Kernel blur, edge, point;
};

// Scales the weights of a derivative: positive ones sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0.0, negative = 0.0;
  for (const double weight : kernel) (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0.0 ? positive : negative;
  return kernel;
}

void addFeatureKernels(Filters& filters, double pixelsPerDegree) {
  const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
  const double reach = std::ceil(3.0 * sigma);
  Kernel blur = gaussian(sigma, filters.radius);
  Kernel edge = blur, point = blur;
  for (size_t i = 0; i < blur.size(); ++i) {
    const double x = double(i) - double(filters.radius);
    const double inside = std::abs(x) <= reach ? 1.0 : 0.0;
    blur[i] *= inside;
    edge[i] *= -x * inside;
    point[i] *= (x * x / (sigma * sigma) - 1.0) * inside;
  }
  filters.blur = normalised(blur);
  filters.edge = balanced(edge);
  filters.point = balanced(point);
}

Filters makeFilters(double pixelsPerDegree) {
  Filters filters;
  filters.radius = size_t(std::ceil(3.0 * sigmaInPixels(kWidestVariance, pixelsPerDegree)));
  const auto kernel = [&](const Sensitivity& s) {
    return gaussian(sigmaInPixels(s.variance, pixelsPerDegree), filters.radius);
  };
  filters.achromatic = normalised(kernel(kAchromatic));
  filters.redGreen = normalised(kernel(kRedGreen));
  double total = 0.0;
  for (int i = 0; i < 2; ++i) {
    const Kernel raw = kernel(kBlueYellow[i]);
    double sum = 0.0;
    for (const double weight : raw) sum += weight;
    // In two dimensions a term's weights are the products of the horizontal and vertical weights.
    filters.blueYellowShare[i] =
        kBlueYellow[i].scale * std::sqrt(std::numbers::pi / kBlueYellow[i].variance) * sum * sum;
    total += filters.blueYellowShare[i];
    filters.blueYellow[i] = normalised(raw);
  }
  for (double& share : filters.blueYellowShare) share /= total;
  addFeatureKernels(filters, pixelsPerDegree);
  return filters;
}

// A band of an image as an observer perceives it.
struct Seen {
  std::vector<glm::dvec3> lab;  // filtered, with the chroma of the Hunt effect
  Plane edgeX, edgeY, pointX, pointY;
};

using Display = std::function<glm::dvec3(const glm::dvec3& linear)>;  // result in 0..1

Seen look(const Image& image, size_t firstRow, size_t rows, const Filters& filters,
          const Display& display) {
  std::vector<glm::dvec3> band = bandOfPixels(image, firstRow, rows, filters.radius);
  const size_t width = image.width + 2 * filters.radius, height = rows + 2 * filters.radius;
  Plane y(width, height), cx(width, height), cz(width, height), grey(width, height);
  for (size_t i = 0; i < band.size(); ++i) {
    const glm::dvec3 opponent = flip::opponentFromLinear(display(band[i]));
    y.values[i] = opponent.x;
    cx.values[i] = opponent.y;
    cz.values[i] = opponent.z;
    grey.values[i] = (opponent.x + 16.0) / 116.0;
  }
  Seen seen;
  seen.edgeX = filtered(grey, filters.edge, filters.blur);
  seen.edgeY = filtered(grey, filters.blur, filters.edge);
  seen.pointX = filtered(grey, filters.point, filters.blur);
  seen.pointY = filtered(grey, filters.blur, filters.point);
  const Plane fy = filtered(y, filters.achromatic, filters.achromatic);
  const Plane fcx = filtered(cx, filters.redGreen, filters.redGreen);
  const Plane fcz0 = filtered(cz, filters.blueYellow[0], filters.blueYellow[0]);
  const Plane fcz1 = filtered(cz, filters.blueYellow[1], filters.blueYellow[1]);
  seen.lab.resize(fy.values.size());
  for (size_t i = 0; i < seen.lab.size(); ++i) {
    const glm::dvec3 opponent(
        fy.values[i], fcx.values[i],
        filters.blueYellowShare[0] * fcz0.values[i] + filters.blueYellowShare[1] * fcz1.values[i]);
    glm::dvec3 linear = flip::linearFromOpponent(opponent);
    for (int c = 0; c < 3; ++c) linear[c] = clampUnit(linear[c]);
    seen.lab[i] = flip::huntLabFromLinear(linear);
  }
  return seen;
}

// HyAB distance (city block in lightness, Euclidean in chroma), compressed.
double colorDistance(const glm::dvec3& a, const glm::dvec3& b) {
  const double distance = std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
  return std::pow(distance, kColorExponent);
}

// Largest error between two colours of a screen: green against blue.
double largestColorDistance() {
  static const double largest =
      colorDistance(flip::huntLabFromLinear({0, 1, 0}), flip::huntLabFromLinear({0, 0, 1}));
  return largest;
}

// Maps a colour distance to 0..1. Most errors are far below the largest: they get most of the
// scale.
double colorError(const glm::dvec3& a, const glm::dvec3& b) {
  const double distance = colorDistance(a, b), largest = largestColorDistance();
  const double knee = kKneeOfError * largest;
  if (distance < knee) return kKneeOfResult * distance / knee;
  return kKneeOfResult + (1.0 - kKneeOfResult) * (distance - knee) / (largest - knee);
}

double featureError(const Seen& a, const Seen& b, size_t i) {
  const auto length = [i](const Plane& x, const Plane& y) {
    return std::hypot(x.values[i], y.values[i]);
  };
  const double edge = std::abs(length(a.edgeX, a.edgeY) - length(b.edgeX, b.edgeY));
  const double point = std::abs(length(a.pointX, a.pointY) - length(b.pointX, b.pointY));
  return std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
}

// Raises `value` to `other`. A NaN, once there, stays.
void raise(double& value, double other) {
  if (!(other <= value) && !std::isnan(value)) value = other;
}

void addDisplayed(const Image& image, const Image& reference, const Filters& filters,
                  const Display& display, std::vector<double>& worst) {
  forEachBand(image.height, [&](size_t firstRow, size_t rows) {
    const Seen a = look(image, firstRow, rows, filters, display);
    const Seen b = look(reference, firstRow, rows, filters, display);
    for (size_t i = 0; i < a.lab.size(); ++i) {
      const double error = std::pow(colorError(a.lab[i], b.lab[i]), 1.0 - featureError(a, b, i));
      raise(worst[firstRow * image.width + i], error);
    }
  });
}

}  // namespace

std::vector<double> flipLdrPerPixel(const Image& image, const Image& reference,
                                    double pixelsPerDegree) {
  std::vector<double> worst(image.pixels.size(), 0.0);
  const Display clip = [](const glm::dvec3& linear) {
    return glm::dvec3(clampUnit(linear.x), clampUnit(linear.y), clampUnit(linear.z));
  };
  addDisplayed(image, reference, makeFilters(pixelsPerDegree), clip, worst);
  return worst;
}

std::vector<double> flipHdrPerPixel(const Image& image, const Image& reference,
                                    const FlipExposures& exposures, double pixelsPerDegree) {
  std::vector<double> worst(image.pixels.size(), 0.0);
  const Filters filters = makeFilters(pixelsPerDegree);
  for (uint32_t i = 0; i < exposures.count; ++i) {
    const double step = exposures.count > 1 ? double(i) / double(exposures.count - 1) : 0.0;
    const double factor = std::exp2(exposures.start + step * (exposures.stop - exposures.start));
    const Display toneMapped = [factor](const glm::dvec3& linear) {
      glm::dvec3 shown;
      for (int c = 0; c < 3; ++c) shown[c] = flip::toneMap(factor * linear[c]);
      return shown;
    };
    addDisplayed(image, reference, filters, toneMapped, worst);
  }
  return worst;
}

}  // namespace restlab
