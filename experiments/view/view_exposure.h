// Exposure with which a page opens a scene.
#pragma once

#include "experiments/view/live_view.h"

namespace restlab {

// Returns the exposure that reports use (previewExposure), from the reference or else the first
// pane's last frame; 1 if there is neither.
double exposureOf(const LiveView& view);

// True if there is a picture, and each pixel of all of them is black: the panes' and the
// reference's.
bool isNothingLit(const LiveView& view);

// Estimates previewExposure() of the noise-free picture. With few samples most pixels are black and
// the others far too bright: the average is over means of 8x8 blocks. Clipping is judged on single
// pixels and on 2x2 means: a block at a lamp's edge would be as bright as the lamp.
float exposureOfNoise(const Image& image);

// Means over blocks of `side` x `side` pixels; blocks at the right and bottom edges may be smaller.
Image blockMeans(const Image& image, uint32_t side);

}  // namespace restlab
