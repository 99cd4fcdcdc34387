// 8-bit pictures of figures, and their PNGs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "experiments/report/pixels.h"

namespace restlab {

// Row 0 on top; R, G, B in sRGB for each pixel.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> bytes;
};

// Converts radiance x exposure of the crop as core/image/io/srgb.h does; each pixel becomes a
// square of `scale` x `scale`.
Picture pictureOf(const Image& image, const Crop& crop, float exposure, uint32_t scale);

// Resizes by area averages of radiance: a smaller picture keeps its brightness.
Image resized(const Image& image, uint32_t width, uint32_t height);

// Encodes a PNG file (core/image/io/png.h) with these texts.
std::string encodePng(const Picture& picture,
                      const std::map<std::string, std::string>& metadata = {});

}  // namespace restlab
