// Masks that select the pixels of an image that count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// One byte per pixel, row 0 on top: not 0 if the pixel counts. Empty: all pixels count.
using PixelMask = std::vector<uint8_t>;

inline bool isSelected(const PixelMask& mask, size_t pixel) {
  return mask.empty() || mask[pixel] != 0;
}

// Number of selected pixels in an image of `pixels` pixels. Throws Error (badInput) if the mask has
// another size or selects nothing.
size_t countSelected(const PixelMask& mask, size_t pixels);

// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRectangle {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Selects the pixels in any of the rectangles. Throws Error (badInput) if one is empty or leaves
// the image.
PixelMask maskOfRectangles(uint32_t width, uint32_t height,
                           const std::vector<PixelRectangle>& rectangles);

// Selects pixels with a channel that is not 0. Throws Error (badInput) on non-finite values.
PixelMask maskOfImage(const Image& image);

// Selects pixels that both masks select.
PixelMask intersection(const PixelMask& a, const PixelMask& b);

}  // namespace restlab
