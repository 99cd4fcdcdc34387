// What a viewer shows, as a file: an EXR of what was rendered, with the metadata of `render`.
#pragma once

#include <string>

#include "experiments/view/live_view.h"

namespace restlab {

// `image`: that of a pane, or after those the reference. "door-ajar-A-restir_gi.exr".
std::string pictureName(const LiveView& view, size_t image);

// Bytes of the file: of a method its last frame as floats; of the reference its mean, halves and
// variance; an image as its file is. Throws Error (badUsage) where it is not there yet.
std::string pictureBytes(const LiveView& view, size_t image);

}  // namespace restlab
