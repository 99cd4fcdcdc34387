// Parts that find what a view shows, for parts that ask for it by the names of these buffers:
//   "visible", "visible_before"   what each pixel shows at its centre, in this view and in the last
//                                 frame's: for histories that follow surfaces
//                                 (core/dialect/visible.h)
//   "guide", "guide_before"       what the film samples of this frame show, in a still view their
//                                 mean; and that of the last frame: for denoisers
//                                 (core/kernels/guide_data.h)
//   "motion"                      where the last frame showed it
#pragma once

#include <vector>

#include "core/part.h"

namespace restlab {

// `parts`, after those of these parts whose buffers one of them asks for.
std::vector<const PartInfo*> withViewParts(std::vector<const PartInfo*> parts);

}  // namespace restlab
