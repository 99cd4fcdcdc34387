// Layers (pictures) of caches with entries: one number per pixel.
#pragma once

#include <functional>
#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Layers that all caches with entries have.
std::vector<LayerInfo> entryLayers();

// Layer of a number that each entry has: `value` of the pixel's entry, 0 if the pixel has none.
std::function<float(size_t pixel)> ofPixelsEntry(const FrameSnapshot& snapshot,
                                                 std::function<float(uint32_t entry)> value);

}  // namespace restlab
