// Host side of partners (spatial neighbours): parameters of an integrator whose pixels exchange
// samples. Caches use the same two thresholds: similarity over space is similarity over time.
#pragma once

#include <string>
#include <vector>

#include "core/part.h"
#include "core/resampling/partners.h"

namespace restlab {

// Parameters spatial_radius, normal_threshold and plane_threshold.
std::vector<ParameterInfo> partnerParameters();
// Pack the parameters of partnerParameters().
rl::SurfaceTest packSurfaceTest(const ParameterMap& parameters);
rl::PartnerParams packPartners(const ParameterMap& parameters);

}  // namespace restlab
