// Noise of a reference's two halves: its effect on all numbers measured against them.
//
// With the truth t, halves t + e and t + f of covariance V (of the channels of a pixel) and runs of
// bias b, the mean of (run - half0)(run - half1) over runs holds (b - e)(b - f) of every pixel. The
// mean of this product is the squared bias. Its spread, 2 b V b + tr(V V), is the same for all
// runs, so the runs cannot show it; the difference of the halves, d = half0 - half1, does. Pixels
// are independent of each other.
#pragma once

#include <vector>

#include "core/image/image.h"
#include "core/image/metrics/mask.h"

namespace restlab {

struct HalvesNoise {
  double varianceOfHalf = 0.0;  // mean over pixels and channels
  // Variance of the mean over pixels and channels of e f, which the errors of all methods have in
  // common. Estimated from d alone: (d d)^2 / 12 per pixel, right for normal noise that all
  // channels share and too large, by at most 5/3, for independent channels; too large for noise of
  // heavier tails.
  double varianceOfProduct = 0.0;
  // Smallest possible value for normal noise: a covariance that is too large would make the
  // interval of a ratio too narrow.
  double varianceOfProductAtLeast() const { return 0.6 * varianceOfProduct; }
};

// Throws Error (badInput) on different sizes or a mask that selects nothing.
HalvesNoise halvesNoise(const Image& half0, const Image& half1, const PixelMask& mask = {});

// Variance of the mean over pixels and channels of (b - e)(b - f), from two or more runs: the mean
// over all pairs i != j of the product of their x d with x = run - (half0 + half1) / 2. Unbiased
// for normal noise. May be negative if the runs' own noise is large.
double sharedVariance(const std::vector<Image>& runs, const Image& half0, const Image& half1,
                      const PixelMask& mask = {});

// Estimates sharedVariance() from one run: too large by the contribution of the run's own noise.
double sharedVarianceAtMost(const Image& run, const Image& half0, const Image& half1,
                            const PixelMask& mask = {});

}  // namespace restlab
