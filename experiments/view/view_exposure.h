// How bright a page shows a scene at first.
#pragma once

#include "experiments/view/live_view.h"

namespace restlab {

// As reports have it (previewExposure), of the reference or of the first pane's last frame; 1 where
// there is neither. Of means over blocks of pixels: of a frame of few samples most pixels are black
// and the others far too bright.
double exposureOf(const LiveView& view);

// Means over blocks of so many pixels a side; those at the right and below may be smaller.
Image blockMeans(const Image& image, uint32_t side);

}  // namespace restlab
