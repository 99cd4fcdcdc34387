// Structural similarity: Wang et al., "Image Quality Assessment: From Error Visibility to
// Structural Similarity" (2004).
#pragma once

#include <vector>

#include "core/image/image.h"

namespace restlab {

// One value per pixel, 1 where both images are the same: the mean over R, G and B of the paper's
// index with K1 = 0.01, K2 = 0.03, range 1 and weights exp(-x^2 / 4.5) over 11x11 pixels, computed
// on linear values that are clipped to 0..1 and sRGB encoded. Borders repeat the edge's pixels.
// Image and reference have the same size.
std::vector<double> ssimPerPixel(const Image& image, const Image& reference);

}  // namespace restlab
