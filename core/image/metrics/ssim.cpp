#include "core/image/metrics/ssim.h"

#include "core/image/color.h"
#include "core/image/metrics/plane.h"

namespace restlab {
namespace {

constexpr size_t kRadius = 5;  // 11 pixels across
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // (K range)^2

Plane encodedChannel(const std::vector<glm::dvec3>& band, size_t width, int channel) {
  Plane plane(width, band.size() / width);
  for (size_t i = 0; i < band.size(); ++i) {
    plane.values[i] = encodeSrgb(clampUnit(band[i][channel]));
  }
  return plane;
}

Plane windowed(const Plane& a, const Plane& b, const Kernel& window) {
  Plane product(a.width, a.height);
  for (size_t i = 0; i < product.values.size(); ++i) product.values[i] = a.values[i] * b.values[i];
  return filtered(product, window, window);
}

// Adds a third of the SSIM index of one channel of a band.
void addIndex(const Plane& a, const Plane& b, const Kernel& window, double* sum) {
  const Plane meanA = filtered(a, window, window), meanB = filtered(b, window, window);
  const Plane aa = windowed(a, a, window), bb = windowed(b, b, window), ab = windowed(a, b, window);
  for (size_t i = 0; i < meanA.values.size(); ++i) {
    const double ma = meanA.values[i], mb = meanB.values[i];
    const double varianceA = aa.values[i] - ma * ma, varianceB = bb.values[i] - mb * mb;
    const double covariance = ab.values[i] - ma * mb;
    sum[i] += (2.0 * ma * mb + kC1) * (2.0 * covariance + kC2) /
              ((ma * ma + mb * mb + kC1) * (varianceA + varianceB + kC2)) / 3.0;
  }
}

}  // namespace

std::vector<double> ssimPerPixel(const Image& image, const Image& reference) {
  std::vector<double> map(image.pixels.size(), 0.0);
  const Kernel window = normalised(gaussian(kSigma, kRadius));
  const size_t width = image.width + 2 * kRadius;
  forEachBand(image.height, [&](size_t firstRow, size_t rows) {
    const auto bandA = bandOfPixels(image, firstRow, rows, kRadius);
    const auto bandB = bandOfPixels(reference, firstRow, rows, kRadius);
    for (int c = 0; c < 3; ++c) {
      addIndex(encodedChannel(bandA, width, c), encodedChannel(bandB, width, c), window,
               map.data() + firstRow * image.width);
    }
  });
  return map;
}

}  // namespace restlab
