// What a cache of entries keeps of every pixel, as pictures.
#pragma once

#include <functional>
#include <vector>

#include "core/part.h"

namespace restlab {

// The layers that all such caches have.
std::vector<LayerInfo> entryLayers();

// A layer of something that each entry has: its number for an entry, by way of the entry of each
// pixel; 0 where a pixel has none.
std::function<float(size_t pixel)> ofPixelsEntry(const Kept& kept,
                                                 std::function<float(uint32_t entry)> value);

}  // namespace restlab
