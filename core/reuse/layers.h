// Layers of methods with reservoirs: what the passes of reuse left of a pixel in the last frame.
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Layers confidence, age, entry_confidence, rejected_shifts and partner. `reservoirUvec4s`: of a
// reservoir of the method.
std::vector<LayerInfo> reuseLayers(uint32_t reservoirUvec4s);

}  // namespace restlab
