// Range of radiance in which filters that compare squares stay within float32.
#pragma once

#include <string>

#include "core/frame/denoiser.h"
#include "core/image/image.h"

namespace restlab {

// Filters that compare squares (DenoiserInfo::comparesSquares) scale with the radiance to the last
// bit within this range, all other filters from 2^-60 to 2^60 (tests/conformance/scaling_test.cpp).
constexpr double kLeastFiltered = 0x1p-40, kMostFiltered = 0x1p40;

// Returns a warning if the mean luminance of the lit pixels is outside the range of such a filter;
// "" if not, or if no pixel is lit.
std::string whyOutsideRange(const DenoiserInfo& denoiser, const Image& radiance);

}  // namespace restlab
