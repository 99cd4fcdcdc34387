// Layers of restir_gi that show what its exchange over space did in the last frame.
#pragma once

#include <vector>

#include "core/part.h"

namespace restlab {

// rejected_shifts and partner. They are read off the exchange's buffer: no pass writes them.
std::vector<LayerInfo> giDonorLayers();

}  // namespace restlab
