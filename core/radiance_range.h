// Where float32 ends for filters: they compare squares of radiance.
#pragma once

#include <string>

#include "core/denoiser.h"
#include "core/image/image.h"

namespace restlab {

// Filters that compare squares (DenoiserInfo::comparesSquares) scale with the radiance to the last
// bit between these, all else from 2^-60 to 2^60 (tests/conformance/scaling_test.cpp).
constexpr double kLeastFiltered = 0x1p-40, kMostFiltered = 0x1p40;

// A line that says that a filter of such light is beyond that range, by the mean of its lit pixels;
// "" where it is not, or where nothing is lit.
std::string whyOutsideRange(const DenoiserInfo& denoiser, const Image& radiance);

}  // namespace restlab
