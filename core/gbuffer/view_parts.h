// Parts that find the visible surfaces, for parts that use them by the names of these buffers:
//   "visible", "visible_before"   surface at each pixel's centre, in this view and in the last
//                                 frame's: for histories that follow surfaces
//                                 (core/gbuffer/visible.h)
//   "guide", "guide_before"       features of the film samples of this frame (in a still view their
//                                 mean) and of the last frame: for denoisers
//                                 (core/gbuffer/guide_data.h)
//   "motion"                      position in the last frame
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Returns `parts`, preceded by those view parts whose buffers one of them uses.
std::vector<const PartInfo*> withViewParts(std::vector<const PartInfo*> parts);

}  // namespace restlab
