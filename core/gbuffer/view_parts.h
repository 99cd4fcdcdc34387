// Parts that find the visible surfaces, for the parts that need them (FrameBuffers):
//   surfaces   at each pixel's centre, in this view and in the last frame's: for histories that
//              follow surfaces (core/gbuffer/gbuffer.h)
//   features   of the film samples of this frame (in a still view their mean) and of the last
//              frame, with their motion: for denoisers (core/gbuffer/guide_data.h)
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Returns `parts`, preceded by those view parts that one of them needs.
std::vector<const PartInfo*> withViewParts(std::vector<const PartInfo*> parts);

}  // namespace restlab
