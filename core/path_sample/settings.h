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
// Parameters of methods whose shift replays a prefix.
std::vector<ParameterInfo> replayParameters();
// Returns why such a parameter has no effect beside others; "" if it has.
std::string replayReasonUnused(const std::string& name, const ParameterMap& parameters);
// Parameters of methods that resample direct light alone: shifts have no Jacobian, and visibility
// may be left to shading.
std::vector<ParameterInfo> directParameters();
bool hasUnshadowedTarget(const ParameterMap& parameters);
rl::PathParams packPath(const ParameterMap& parameters);

// Values of a reservoir of any method: W and the confidence, each as its word.
std::vector<ProbeValue> weightProbe(uint32_t W, uint32_t confidence);
// Values of a reservoir. `words`: as core/path_sample/path_words.glsl lays it out.
std::vector<ProbeValue> pathProbe(std::span<const uint32_t> words);

}  // namespace restlab
