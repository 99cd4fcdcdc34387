// Host side of pairs of spatial neighbours: parameters of an integrator whose pixels exchange
// samples. Caches use the same two thresholds: similarity over space is similarity over time.
#pragma once

#include <string>
#include <vector>

#include "core/frame/part.h"
#include "core/resampling/pairs.h"

namespace restlab {

// Parameters spatial_radius, normal_threshold and plane_threshold.
std::vector<ParameterInfo> pairParameters();
// Pack the parameters of pairParameters().
rl::SimilarityThresholds packSimilarity(const ParameterMap& parameters);
rl::PairParams packPairs(const ParameterMap& parameters);

}  // namespace restlab
