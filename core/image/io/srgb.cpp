#include "core/image/io/srgb.h"

#include <cmath>

#include "core/image/color.h"

namespace restlab {
namespace {

// Comparisons are written so that NaN cannot reach the conversion to an integer.
uint8_t encodeSrgb8(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 255;
  return uint8_t(encodeSrgb(linear) * 255.0f + 0.5f);
}

}  // namespace

std::vector<uint8_t> srgbBytes(const Image& image, float exposure) {
  std::vector<uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const glm::vec3& pixel : image.pixels) {
    if (std::isnan(pixel.x) || std::isnan(pixel.y) || std::isnan(pixel.z)) {
      bytes.insert(bytes.end(), {255, 0, 255});
    } else {
      for (int c = 0; c < 3; ++c) bytes.push_back(encodeSrgb8(pixel[c] * exposure));
    }
  }
  return bytes;
}

}  // namespace restlab
