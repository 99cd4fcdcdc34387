// Parameters that denoisers share.
#pragma once

#include <string>

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
// Parameter "NAME_iterations": number of passes of a wavelet filter.
ParameterInfo iterationsParameter(const std::string& name, int64_t defaultValue,
                                  const std::string& source);
// Name of the pass of iteration i, counted from 0: "NAME 1" and so on.
inline std::string iterationName(const std::string& name, uint32_t i) {
  return name + " " + std::to_string(i + 1);
}
// Iteration i reaches 2^i pixels: this many cover 127 to each side.
constexpr int kMostIterations = 7;

}  // namespace restlab
