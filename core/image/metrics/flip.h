// FLIP, an estimate of the difference that a viewer perceives who flips between two images on a
// screen: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (2020); for
// radiance without an upper bound Andersson et al., "Visualizing Errors in Rendered High Dynamic
// Range Images" (2021).
//
// The value of a pixel is in 0..1, 0 where nothing differs. Borders repeat the edge's pixels. Image
// and reference have the same size. A NaN is NaN in every pixel that it reaches through the
// filters.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace restlab {

// Viewing condition of the papers: 0.7 m from a screen that is 0.7 m and 3840 pixels wide.
constexpr double kFlipPixelsPerDegree = 67.02064327658225;
// Range that the filters are defined for: below it they are narrower than a pixel.
constexpr double kFlipMinPixelsPerDegree = 1.0, kFlipMaxPixelsPerDegree = 1000.0;

// `count` factors 2^start to 2^stop on radiance, evenly spaced in the exponent.
struct FlipExposures {
  double start = 0.0, stop = 0.0;
  uint32_t count = 0;
};

struct FlipOptions {
  double pixelsPerDegree = kFlipPixelsPerDegree;
  std::optional<FlipExposures> exposures;  // absent: chooseFlipExposures
};

constexpr double kFlipMaxExposure = 100.0;  // stops, in either direction
constexpr uint32_t kFlipMaxExposures = 64;  // each takes seconds

// Throws Error (badUsage) naming the option out of range: pixels per degree, or given exposures.
void requireFlipOptions(const FlipOptions& options);

struct FlipExposureChoice {
  std::optional<FlipExposures> exposures;  // absent: none possible, and `note` says why
  std::string note;                        // how the paper's rule was changed; or ""
};

// Chooses the paper's range: the lowest exposure shows the brightest pixel of the reference, the
// highest its median at 0.85 of the tone-mapped scale; ceil(stop - start) steps, at least 2. If the
// median is not positive (most of the image is black), uses the median of the pixels that have
// light.
FlipExposureChoice chooseFlipExposures(const Image& reference);

// FLIP of linear Rec. 709 as shown on a screen: clipped to 0..1.
std::vector<double> flipLdrPerPixel(const Image& image, const Image& reference,
                                    double pixelsPerDegree = kFlipPixelsPerDegree);

// HDR-FLIP: the largest error over the exposures after tone mapping (Narkowicz's fit of ACES).
// Negative values, for which no tone mapper is defined, count as 0.
std::vector<double> flipHdrPerPixel(const Image& image, const Image& reference,
                                    const FlipExposures& exposures,
                                    double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace restlab
