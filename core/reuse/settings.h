// Host side of the passes of reuse: parameters that every method with reservoirs has.
#pragma once

#include <string>
#include <vector>

#include "core/frame/part.h"
#include "core/reuse/reuse.h"

namespace restlab {

// Parameters of the passes, and of pairs of neighbours (core/resampling/pair_settings.h).
std::vector<ParameterInfo> reuseParameters();
// `assumesVisible`: the mode takes samples of the last frame as visible (biased).
rl::ReuseParams packReuse(const ParameterMap& parameters, bool assumesVisible);
// PartInfo::reasonUnused of such a method.
std::string reuseReasonUnused(const std::string& name, const ParameterMap& parameters);
// IntegratorInfo::radianceFrames of such a method.
double reuseRadianceFrames(const ParameterMap& parameters);
// Returns whether parameters make a method biased: MIS weights by confidence alone, where shifts
// are not the identity, or caps that depend on samples.
bool reuseIsBiased(const ParameterMap& parameters);

}  // namespace restlab
