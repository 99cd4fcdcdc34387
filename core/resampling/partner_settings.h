// Host side of partners: parameters of an integrator whose pixels exchange samples. Its caches use
// the two thresholds, too: what is alike over space is alike over time.
#pragma once

#include <string>
#include <vector>

#include "core/part.h"
#include "core/resampling/partners.h"

namespace restlab {

// spatial_radius, normal_threshold, plane_threshold.
std::vector<ParameterInfo> partnerParameters();
// Of a method whose integrator has them.
rl::SurfaceTest packSurfaceTest(const ParameterMap& parameters);
rl::PartnerParams packPartners(const ParameterMap& parameters);

}  // namespace restlab
