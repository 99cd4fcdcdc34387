// What the merges of restir_gi did at a pixel in the last frame, computed again on the host.
#pragma once

#include <vector>

#include "core/part.h"

namespace restlab {

// The pixel's own sample, then the donors over space, over time and of its entries. The merge over
// space is that of the frame to the last bit. Of the merge over time the donor's state is gone, as
// the frame has written over it: its share is what the pixel's own sample, traced again, leaves.
std::vector<Donor> giDonorsOf(const Kept& kept, size_t pixel);

}  // namespace restlab
