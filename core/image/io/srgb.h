// Radiance as 8-bit sRGB, for previews and figures; nothing is computed from it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// Encodes each pixel of radiance x exposure as R, G, B, clipped to 0..1, by IEC 61966-2-1. A pixel
// with a NaN becomes magenta: it must be seen.
std::vector<uint8_t> srgbBytes(const Image& image, float exposure);

}  // namespace restlab
