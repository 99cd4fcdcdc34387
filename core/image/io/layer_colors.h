// False colours for layers that hold no radiance.
#pragma once

#include "core/image/image.h"

namespace restlab {

// Maps each number of the first channel to a colour, equal for equal numbers; 0 is black.
Image falseColors(const Image& names);

// Least and greatest finite value of all channels; 0 and 0 if there is none.
struct ValueRange {
  float least = 0.0f, greatest = 0.0f;
};
ValueRange valueRange(const Image& image);

// Maps the range to 0..1, so that 8-bit sRGB has even steps; all 0 if the range is empty.
Image scaledTo(const Image& image, const ValueRange& range);

}  // namespace restlab
