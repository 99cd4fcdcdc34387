// Merges of restir_gi at a pixel in the last frame, computed again on the host.
#pragma once

#include <vector>

#include "core/frame/part.h"

namespace restlab {

// Returns the pixel's own sample, then its spatial donors, its temporal donor and its entries. The
// frame has overwritten the reservoir of the temporal donor. The initial candidate is traced again:
// what its resampling weight leaves of wSum is the donor's.
std::vector<Donor> giDonorsOf(const FrameSnapshot& snapshot, size_t pixel);

}  // namespace restlab
