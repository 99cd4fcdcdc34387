// Parameters that denoisers share.
#pragma once

#include <string>

#include "core/frame/schema.h"
#include "denoise/common/filter.h"

namespace restlab {

// Iteration i reaches 2^i pixels: this many cover 127 to each side.
constexpr int kMostIterations = 7;

// Reflectances that the radiance is divided by; the features read it (core/gbuffer/view_parts.cpp).
struct DemodulateSettings {
  std::string demodulate = "all";
};
const Schema<DemodulateSettings>& demodulateSchema();

struct EdgeSettings {
  double plane = 0.02;
  double normal = 0.1;
};
// Parameters "demodulate", "edge_plane" and "edge_normal".
std::vector<ParameterInfo> filterParameters();
rl::FilterEdges packFilterEdges(const ParameterMap& parameters);

// Number of passes of a wavelet filter.
template <class Settings>
Parameter<Settings> iterationsParameter(uint32_t Settings::*member, const char* name,
                                        const char* source) {
  return Parameter<Settings>(member, name, Range{0, kMostIterations},
                             "wavelet iterations; iteration i reaches 2^i pixels to each side",
                             source)
      .beginsHistory();
}
template <class Settings>
Parameter<Settings> deviationsParameter(double Settings::*member, const char* name) {
  return Parameter<Settings>(
      member, name, Range{1.0e-3, 1.0e6},
      "standard deviations that mean luminances around two pixels may differ by",
      "measured: docs/denoising.md");
}
// Name of the pass of iteration i, counted from 0: "NAME 1" and so on.
inline std::string iterationName(const std::string& name, uint32_t i) {
  return name + " " + std::to_string(i + 1);
}

}  // namespace restlab
