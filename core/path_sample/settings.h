// Host side of path samples: parameters of the methods that resample paths, and what a reservoir of
// one holds, for people.
#pragma once

#include <span>
#include <vector>

#include "core/frame/part.h"
#include "core/path_sample/path_sample.h"

namespace restlab {

// Parameters light_candidates, roughness_limit and max_jacobian.
std::vector<ParameterInfo> pathParameters();
rl::PathParams packPath(const ParameterMap& parameters);

// Values of a reservoir. `words`: as pathReservoirWrite() lays it out.
std::vector<ProbeValue> pathProbe(std::span<const uint32_t> words);

}  // namespace restlab
