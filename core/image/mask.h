// Which pixels of an image count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// One byte a pixel, row 0 on top: other than 0 where the pixel counts. Empty: all pixels count.
using PixelMask = std::vector<uint8_t>;

inline bool isSelected(const PixelMask& mask, size_t pixel) {
  return mask.empty() || mask[pixel] != 0;
}

// Of an image of `pixels` pixels. Throws Error (badInput) where the mask is of another size or
// selects nothing.
size_t countSelected(const PixelMask& mask, size_t pixels);

// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRectangle {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// The pixels that are in any of the rectangles. Throws Error (badInput) where one is empty or
// leaves the image.
PixelMask maskOfRectangles(uint32_t width, uint32_t height,
                           const std::vector<PixelRectangle>& rectangles);

// The pixels of which a channel is not 0. Throws Error (badInput) on a value that is not finite.
PixelMask maskOfImage(const Image& image);

// The pixels that both select.
PixelMask intersection(const PixelMask& a, const PixelMask& b);

}  // namespace restlab
