// Exposure with which a page opens a scene.
#pragma once

#include "experiments/view/live_view.h"

namespace restlab {

// Returns previewExposure() of the reference; without one, of the first image of a file or of the
// first pane's last frame; 1 if there is nothing.
double exposureOf(const LiveView& view);

// True if there is a picture, and each pixel of all of them is black: the panes' and the
// reference's.
bool isNothingLit(const LiveView& view);

}  // namespace restlab
