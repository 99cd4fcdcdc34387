// Host side of path samples: parameters of the methods that resample paths.
#pragma once

#include <vector>

#include "core/frame/part.h"
#include "core/path_sample/path_sample.h"

namespace restlab {

// Parameters light_candidates, roughness_limit and max_jacobian.
std::vector<ParameterInfo> pathParameters();
// Parameters of methods whose shift replays a prefix.
std::vector<ParameterInfo> replayParameters();
// Returns why such a parameter has no effect beside others; "" if it has.
std::string replayReasonUnused(const std::string& name, const ParameterMap& parameters);
// Parameters of methods that resample direct light alone: shifts have no Jacobian, and visibility
// may be left to shading.
std::vector<ParameterInfo> directParameters();
bool hasUnshadowedTarget(const ParameterMap& parameters);
rl::PathParams packPath(const ParameterMap& parameters);

}  // namespace restlab
