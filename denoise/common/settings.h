// Parameters that denoisers share.
#pragma once

#include "core/frame/part.h"
#include "denoise/common/filter.h"

namespace restlab {

// Parameter "demodulate", which the guides read (core/gbuffer/view_parts.cpp).
ParameterInfo demodulateParameter();
// Parameters "demodulate", "edge_plane" and "edge_normal".
std::vector<ParameterInfo> filterParameters();
rl::FilterEdges packFilterEdges(const ParameterMap& parameters);

// Parameter "NAME_deviations".
ParameterInfo deviationsParameter(const std::string& name, double defaultValue);
// Parameter "NAME_iterations", and its passes "NAME 1", "NAME 2" and so on, of the kernel.
ParameterInfo iterationsParameter(const std::string& name, int64_t defaultValue,
                                  const std::string& source);
std::vector<PassInfo> waveletPasses(const std::string& kernel, const char* parameter);
// Iteration i reaches 2^i pixels: this many cover 127 to each side.
constexpr int kMostIterations = 7;

}  // namespace restlab
