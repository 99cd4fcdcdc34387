// How bright a page shows a scene at first.
#pragma once

#include "experiments/view/live_view.h"

namespace restlab {

// As reports have it (previewExposure), of the reference or of the first pane's last frame; 1 where
// there is neither.
double exposureOf(const LiveView& view);

// Estimates what previewExposure() says of the picture without noise. Of few samples most pixels
// are black and the others far too bright: the average is of means over blocks of 8x8 pixels. What
// is clipped goes by single pixels and 2x2, as a block at a lamp's edge is as bright as the lamp.
float exposureOfNoise(const Image& image);

// Means over blocks of so many pixels a side; those at the right and below may be smaller.
Image blockMeans(const Image& image, uint32_t side);

}  // namespace restlab
