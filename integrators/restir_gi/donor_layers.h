// Layers of restir_gi that show what its exchange over space did in the last frame.
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Layers rejected_shifts and neighbour, read from the paired_shift buffer: no pass writes them.
std::vector<LayerInfo> giDonorLayers();

}  // namespace restlab
