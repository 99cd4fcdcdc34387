#include "core/image/io/layer_colors.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/image/color.h"

namespace restlab {

namespace {

// Integer hash: C. Wellons, "hash prospector", 2018.
uint32_t hashed(uint32_t x) {
  x ^= x >> 16u;
  x *= 0x7feb352du;
  x ^= x >> 15u;
  x *= 0x846ca68bu;
  return x ^ (x >> 16u);
}

glm::vec3 colorOf(float name) {
  if (name == 0.0f) return glm::vec3(0.0f);
  const uint32_t bits = hashed(std::bit_cast<uint32_t>(name));
  // Random in encoded values, and away from black.
  const auto channel = [&](uint32_t shift) {
    return decodeSrgb(0.2f + 0.8f * float((bits >> shift) & 0xffu) / 255.0f);
  };
  return {channel(0), channel(8), channel(16)};
}

}  // namespace

Image falseColors(const Image& names) {
  Image colors(names.width, names.height);
  std::transform(names.pixels.begin(), names.pixels.end(), colors.pixels.begin(),
                 [](const glm::vec3& name) { return colorOf(name.x); });
  return colors;
}

ValueRange valueRange(const Image& image) {
  ValueRange range;
  bool isFirst = true;
  for (const glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(pixel[c])) continue;
      range.least = isFirst ? pixel[c] : std::min(range.least, pixel[c]);
      range.greatest = isFirst ? pixel[c] : std::max(range.greatest, pixel[c]);
      isFirst = false;
    }
  }
  return range;
}

Image scaledTo(const Image& image, const ValueRange& range) {
  Image scaled(image.width, image.height);
  const float width = range.greatest - range.least;
  if (!(width > 0.0f)) return scaled;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      scaled.pixels[i][c] = decodeSrgb((image.pixels[i][c] - range.least) / width);
  }
  return scaled;
}

}  // namespace restlab
