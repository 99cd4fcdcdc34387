// Layers that hold no radiance, as colours to look at.
#pragma once

#include "core/image/image.h"

namespace restlab {

// A colour for each number of the first channel, the same wherever the number stands; 0 is black.
Image falseColors(const Image& names);

// Least and greatest finite value of all channels; 0 and 0 where there is none.
struct ValueRange {
  float least = 0.0f, greatest = 0.0f;
};
ValueRange valueRange(const Image& image);

// The range as 0 to 1, so that 8-bit sRGB has even steps; all of it 0 where the range is empty.
Image scaledTo(const Image& image, const ValueRange& range);

}  // namespace restlab
