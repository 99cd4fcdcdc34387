#include "core/image/metrics/mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace restlab {

size_t countSelected(const PixelMask& mask, size_t pixels) {
  if (mask.empty()) return pixels;
  if (mask.size() != pixels) {
    failInput(fmt::format("mask has {} pixels but the image {}", mask.size(), pixels));
  }
  const size_t count = mask.size() - size_t(std::count(mask.begin(), mask.end(), uint8_t(0)));
  if (count == 0) failInput("mask selects no pixel: metrics need at least one");
  return count;
}

PixelMask maskOfRectangles(uint32_t width, uint32_t height,
                           const std::vector<PixelRectangle>& rectangles) {
  PixelMask mask(size_t(width) * height, 0);
  for (const PixelRectangle& r : rectangles) {
    if (r.x0 >= r.x1 || r.y0 >= r.y1 || r.x1 > width || r.y1 > height) {
      failInput(fmt::format("rectangle {},{},{},{} must have X0 < X1 <= {} and Y0 < Y1 <= {}", r.x0,
                            r.y0, r.x1, r.y1, width, height));
    }
    for (uint32_t y = r.y0; y < r.y1; ++y) {
      const auto row = mask.begin() + std::ptrdiff_t(size_t(y) * width);
      std::fill(row + r.x0, row + r.x1, uint8_t(1));
    }
  }
  return mask;
}

PixelMask maskOfImage(const Image& image) {
  PixelMask mask;
  mask.reserve(image.pixels.size());
  for (const glm::vec3& pixel : image.pixels) {
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y) || !std::isfinite(pixel.z)) {
      failInput("a mask must have finite values: 0 where a pixel does not count");
    }
    mask.push_back(pixel == glm::vec3(0.0f) ? 0 : 1);
  }
  return mask;
}

PixelMask intersection(const PixelMask& a, const PixelMask& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  if (a.size() != b.size()) {
    failInput(fmt::format("masks have {} and {} pixels", a.size(), b.size()));
  }
  PixelMask both(a.size());
  for (size_t p = 0; p < both.size(); ++p) both[p] = a[p] != 0 && b[p] != 0 ? 1 : 0;
  return both;
}

}  // namespace restlab
