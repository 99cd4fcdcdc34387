// Writes an image of the viewer as a file: an EXR of what was rendered, with the metadata of
// `render`.
#pragma once

#include <string>

#include "experiments/view/live_view.h"

namespace restlab {

// Returns a file name such as "door-ajar-A-restir_gi.exr". `image`: index of a pane, or the number
// of panes for the reference.
std::string pictureName(const LiveView& view, size_t image);

// Returns the bytes of the file: the last frame of a method as floats; mean, halves and variance of
// the reference; an image's own file. Throws Error (badUsage) if it does not exist yet.
std::string pictureBytes(const LiveView& view, size_t image);

}  // namespace restlab
