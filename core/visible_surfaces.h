// The part that finds what each pixel's centre shows, for parts whose histories follow surfaces.
// Its buffers: "visible", of this frame's view, and "visible_before", of the last frame's
// (core/dialect/visible.h).
#pragma once

#include <vector>

#include "core/part.h"

namespace restlab {

// `parts`, after that part where one of them asks for its buffers.
std::vector<const PartInfo*> withVisibleSurfaces(std::vector<const PartInfo*> parts);

}  // namespace restlab
