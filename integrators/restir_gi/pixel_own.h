// A pixel's sample of the last frame alone, traced again on the host.
#pragma once

#include <optional>

#include "core/part.h"
#include "integrators/restir_gi/restir_gi.h"

namespace restlab {

// Its resampling weight in the merge over time with the slot `before`, which entered with the
// confidence `cDonor`. Not known where paths end in cells of radiance, which have changed since.
std::optional<float> giOwnWeightOverTime(const Kept& kept, const rl::RestirGiBuffers& buffers,
                                         const rl::RestirGiParams& params, rl::uvec2 pixel,
                                         uint32_t before, float cDonor);

}  // namespace restlab
