// Radiance as 8-bit sRGB, for previews and figures; nothing is computed from it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// R, G, B of each pixel of radiance x exposure, clipped to 0..1 and encoded by IEC 61966-2-1. A
// pixel with a NaN is magenta: it must be seen.
std::vector<uint8_t> srgbBytes(const Image& image, float exposure);

}  // namespace restlab
