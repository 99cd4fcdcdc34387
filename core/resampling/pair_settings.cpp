#include "core/resampling/pair_settings.h"

#include <cmath>

namespace restlab {

std::vector<ParameterInfo> pairParameters() {
  return {
      {"spatial_radius",
       3.0,
       1.5,
       256.0,
       {},
       "pixels; donors come from a square tile that spreads them as a disk of this radius would",
       "near donors differ least where histories are old; Bitterli et al. 2020 use 30"},
      {"normal_threshold",
       0.9,
       -1.0,
       1.0,
       {},
       "least cosine between the normals of two pixels' surfaces",
       "Bitterli et al. 2020: 25 degrees = 0.906"},
      {"plane_threshold",
       0.05,
       0.0,
       10.0,
       {},
       "largest distance from each other's plane over the camera distance",
       "Bitterli et al. 2020 compare depths at 10 %"},
  };
}

rl::SimilarityThresholds packSimilarity(const ParameterMap& parameters) {
  const auto number = [&](const char* name) {
    return static_cast<float>(std::get<double>(parameters.at(name)));
  };
  return {number("normal_threshold"), number("plane_threshold")};
}

rl::PairParams packPairs(const ParameterMap& parameters) {
  // The root mean square distance of two points of a square of side s is s / sqrt(3), that of a
  // point of a disk to its centre r / sqrt(2).
  const double side = std::sqrt(1.5) * std::get<double>(parameters.at("spatial_radius"));
  return {static_cast<uint32_t>(std::lround(side)), packSimilarity(parameters)};
}

}  // namespace restlab
