// Merges of restir_gi at a pixel in the last frame, computed again on the host.
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Returns the pixel's own sample, then its spatial donors, its temporal donor and its entries. The
// frame has overwritten the state of the temporal donor: the donor's share is the rest that the
// pixel's own sample, traced again, leaves.
std::vector<Donor> giDonorsOf(const FrameSnapshot& kept, size_t pixel);

}  // namespace restlab
